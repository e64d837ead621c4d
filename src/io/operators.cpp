#include "tufted/io/operators.h"

#include <cstdint>
#include <vector>

#include "io/npz_archive.h"
#include "io/result_arrays.h"
#include "io/stage_results.h"
#include "io/staged_files.h"
#include "tufted/check.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Faces = Eigen::Matrix<std::int64_t, Eigen::Dynamic, 3, Eigen::RowMajor>;

void checkArguments(const Laplacian& laplacian, const Geometry& geometry, const Gradients& gradients,
                    const Spectrum& spectrum) {
  checkSizes("writeOperators", laplacian);
  const auto n = static_cast<Eigen::Index>(laplacian.status.size());
  const auto check = [](const char* name, Eigen::Index size, const char* unit, Eigen::Index right) {
    if (size != right)
      throw InvalidInput("writeOperators: " + std::string(name) + " has " + std::to_string(size) + unit +
                         ", must have " + std::to_string(right));
  };
  check("geometry", geometry.points.rows(), " rows", n);
  for (const auto& [name, matrix] :
       {std::pair("L", &laplacian.L), {"gradients.X", &gradients.X}, {"gradients.Y", &gradients.Y}}) {
    check(name, matrix->rows(), " rows", n);
    check(name, matrix->cols(), " columns", n);
    if (!matrix->isCompressed()) throw InvalidInput("writeOperators: " + std::string(name) + " must be compressed");
  }
  check("gradients.frames.normals", gradients.frames.normals.rows(), " rows", n);
  check("gradients.frames.tangents", gradients.frames.tangents.rows(), " rows", n);
  check("spectrum.vectors", spectrum.vectors.rows(), " rows", n);
  check("spectrum.vectors", spectrum.vectors.cols(), " columns", spectrum.values.size());
}

template <class T>
void add(io::NpzArchive& archive, const std::string& name, const char* descr, const std::vector<std::int64_t>& shape,
         const T* values) {
  std::int64_t count = 1;
  for (const std::int64_t size : shape) count *= size;
  archive.add(name + ".npy", descr, shape, values, static_cast<std::size_t>(count) * sizeof(T));
}

/// @param shape borrowed until the archive is closed
void addMatrix(io::NpzArchive& archive, const std::string& name, const SparseMatrix& matrix,
               const std::int64_t (&shape)[2]) {
  add(archive, name + "_data", "<f8", {matrix.nonZeros()}, matrix.valuePtr());
  add(archive, name + "_indices", "<i4", {matrix.nonZeros()}, matrix.innerIndexPtr());
  add(archive, name + "_indptr", "<i4", {matrix.cols() + 1}, matrix.outerIndexPtr());
  add(archive, name + "_shape", "<i8", {2}, shape);
}

}  // namespace

void writeOperators(const std::filesystem::path& dir, const Laplacian& laplacian, const Geometry& geometry,
                    const Gradients& gradients, const Spectrum& spectrum, const ResultOptions& options) {
  checkArguments(laplacian, geometry, gradients, spectrum);
  const std::int64_t n = geometry.points.rows(), k = spectrum.values.size();
  const std::int64_t shape[2] = {n, n};
  const Faces faces = geometry.triangles.cast<std::int64_t>();
  const auto axes = io::axesOf(gradients.frames);
  const RowMajor vectors = spectrum.vectors;

  io::StagedFiles files(dir);
  io::NpzArchive archive(files.stage("operators.npz"));
  add(archive, "verts", "<f8", {n, 3}, geometry.points.data());
  add(archive, "faces", "<i8", {faces.rows(), 3}, faces.data());
  add(archive, "frames", "<f8", {n, 3, 3}, axes.data());
  add(archive, "k_eig", "<i8", {}, &k);
  add(archive, "mass", "<f8", {n}, laplacian.M.data());
  addMatrix(archive, "L", laplacian.L, shape);
  add(archive, "evals", "<f8", {k}, spectrum.values.data());
  add(archive, "evecs", "<f8", {n, k}, vectors.data());
  addMatrix(archive, "gradX", gradients.X, shape);
  addMatrix(archive, "gradY", gradients.Y, shape);
  archive.close();
  io::stageResults(files, laplacian, geometry,
                   {{.name = "frames", .values = axes}, {.name = "evecs", .values = spectrum.vectors}}, options);
  files.commit();
}

}  // namespace tufted
