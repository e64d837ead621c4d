#include "tufted/io/write.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "io/columns.h"
#include "io/conventions.h"
#include "io/cover_file.h"
#include "io/matrix_writers.h"
#include "io/npy.h"
#include "io/output_file.h"
#include "io/point_writers.h"
#include "io/pose.h"
#include "io/report_json.h"
#include "io/result_arrays.h"
#include "io/result_folder.h"
#include "io/stage_results.h"
#include "io/staged_files.h"
#include "tufted/components.h"
#include "tufted/dummy_values.h"
#include "tufted/errors.h"
#include "tufted/surface_triangles.h"

namespace tufted {
namespace {

using io::OutputPath;
using Out = const OutputPath&;

/// What the files are written from: L and M compressed, with the sign and the dummy values of the options. Only what is
/// changed is copied; the rest is borrowed.
struct Results {
  Results(const Laplacian& written, const Geometry& of, const WriteOptions& by)
      : laplacian(written), geometry(of), options(by), conventions(io::conventions(written, by)) {
    if (options.dummy) {
      changed_L = laplacian.L;
      changed_M = laplacian.M;
      setDummyValues(*changed_L, *changed_M, laplacian.status);
    }
    if (options.sign != Sign::igl && L().isCompressed()) return;
    if (!changed_L) changed_L = laplacian.L;
    changed_L->makeCompressed();
    if (options.sign == Sign::igl) changed_L->coeffs() = -changed_L->coeffs();
  }
  const SparseMatrix& L() const { return changed_L ? *changed_L : laplacian.L; }
  const VectorXd& M() const { return changed_M ? *changed_M : laplacian.M; }

  const Laplacian& laplacian;
  const Geometry& geometry;
  const WriteOptions& options;
  std::vector<io::Convention> conventions;
  std::optional<SparseMatrix> changed_L = {};
  std::optional<VectorXd> changed_M = {};
};

using In = const Results&;

/// Writes a value for each point.
template <class Values>
void writeValues(const OutputPath& to, const char* descr, const Values& values) {
  io::writeNpy(to, descr, {static_cast<std::int64_t>(values.size())}, values.data());
}

struct ResultFile {
  std::optional<Format> format;  ///< nullopt: always written
  const char* name;
  void (*write)(Out to, In results);
};

const ResultFile result_files[] = {
    {Format::npz, "L.npz", [](Out to, In r) { io::writeNpz(to, r.L()); }},
    {Format::npz, "M.npy", [](Out to, In r) { writeValues(to, "<f8", r.M()); }},
    {Format::npz, "status.npy", [](Out to, In r) { writeValues(to, "|u1", r.laplacian.status); }},
    {Format::npz, "representative.npy", [](Out to, In r) { writeValues(to, "<i4", r.laplacian.representative); }},
    {Format::npz, "boundary.npy", [](Out to, In r) { writeValues(to, "|u1", r.laplacian.boundary); }},
    {Format::npz, "frames.npy", [](Out to, In r) { io::writeFrames(to, r.laplacian.frames); }},
    {Format::npz, "noise.npy", [](Out to, In r) { writeValues(to, "<f8", r.laplacian.noise); }},
    {Format::npz, io::component_edges_name,
     [](Out to, In r) { io::writeComponentEdges(to, r.laplacian.component_edges); }},
    {Format::cover, "cover.npz", [](Out to, In r) { io::writeCover(to, r.laplacian.cover()); }},
    {Format::mtx, "L.mtx", [](Out to, In r) { io::writeMtx(to, r.L(), r.conventions); }},
    {Format::mtx, "M.mtx", [](Out to, In r) { io::writeMtx(to, r.M(), r.conventions); }},
    {Format::mat, "laplacian.mat", [](Out to, In r) { io::writeMat(to, r.L(), r.M(), r.laplacian, r.conventions); }},
    {Format::spmat, "L.spmat", [](Out to, In r) { io::writeSpmat(to, r.L()); }},
    {Format::spmat, "M.spmat", [](Out to, In r) { io::writeSpmat(to, r.M()); }},
    {Format::petsc, "L.petsc", [](Out to, In r) { io::writePetsc(to, r.L()); }},
    {Format::petsc, "M.petsc", [](Out to, In r) { io::writePetsc(to, r.M()); }},
    {Format::ply, "points.ply", [](Out to, In r) { io::writePly(to, r.laplacian, r.geometry, r.M(), r.conventions); }},
    {Format::pcd, "points.pcd", [](Out to, In r) { io::writePcd(to, r.laplacian, r.geometry, r.M(), r.conventions); }},
    {Format::las, "points.las", [](Out to, In r) { io::writeLas(to, r.laplacian, r.geometry, r.M()); }},
    {Format::triangles, "triangles.ply",
     [](Out to, In r) {
       Geometry surface = r.geometry;
       if (r.laplacian.positions.rows() > 0) surface.points = r.laplacian.positions;
       if (!surface.is_mesh) surface.triangles = surfaceTriangles(r.laplacian);
       surface.is_mesh = true;
       surface.width = surface.height = 0;
       io::writePly(to, r.laplacian, surface, r.M(), r.conventions);
     }},
    {std::nullopt, io::positions_name,
     [](Out to, In r) {
       io::writeNpy(to, "<f8", {r.laplacian.positions.rows(), 3}, r.laplacian.positions.data());
     }},
    {std::nullopt, "components.npy",
     [](Out to, In r) {
       // Computed only here, after earlier formats have refused an L that is too large for them.
       const Laplacian& laplacian = r.laplacian;
       writeValues(to, "<i4", laplacian.component.empty() ? componentLabels(laplacian) : laplacian.component);
     }},
    {std::nullopt, io::report_name,
     [](Out to, In r) { io::writeText(to, io::reportJson(r.laplacian, r.geometry, r.options, r.conventions)); }},
};

std::vector<ResultFile> filesOf(const std::vector<Format>& formats) {
  std::vector<ResultFile> files;
  for (const ResultFile& file : result_files)
    if (!file.format || std::find(formats.begin(), formats.end(), *file.format) != formats.end()) files.push_back(file);
  return files;
}

void check(const Laplacian& laplacian, const Geometry& geometry) {
  const auto points = static_cast<std::size_t>(geometry.points.rows());
  const auto require = [](const std::string& name, std::size_t length, std::size_t expected) {
    if (length != expected)
      throw InvalidInput("writeLaplacian: " + name + " has length " + std::to_string(length) + ", not " +
                         std::to_string(expected));
  };
  require("L", laplacian.L.rows(), points);
  require("L", laplacian.L.cols(), points);
  require("M", laplacian.M.size(), points);
  require("status", laplacian.status.size(), points);
  require("representative", laplacian.representative.size(), points);
  require("boundary", laplacian.boundary.size(), points);
  if (!laplacian.component.empty()) require("component", laplacian.component.size(), points);
  if (laplacian.positions.rows() > 0) require("positions", laplacian.positions.rows(), points);
  if (laplacian.noise.size() > 0) require("noise", laplacian.noise.size(), points);
  if (geometry.normals.rows() > 0) require("normals", geometry.normals.rows(), points);
  if (geometry.height > 1)
    require("the grid of width times height", static_cast<std::size_t>(geometry.width) * geometry.height, points);
  if (const char* const fault = io::poseFault(geometry.viewpoint))
    throw InvalidInput(std::string("writeLaplacian: ") + fault);
  for (const Field& field : geometry.fields) {
    require("the field " + field.name, field.bytes.size(), points * field.count * io::sizeOf(field.type));
    if (field.name.empty() || field.name.find_first_of(" \t\r\n") != std::string::npos)
      throw InvalidInput("writeLaplacian: the field name '" + field.name + "' is not one word");
  }
}

}  // namespace

std::vector<std::string> resultFiles(const std::vector<Format>& formats) {
  std::vector<std::string> names;
  for (const ResultFile& file : filesOf(formats)) names.emplace_back(file.name);
  return names;
}

void checkWritable(const std::filesystem::path& dir, const std::vector<std::string>& files) {
  io::StagedFiles staged(dir);
  for (const std::string& name : files) staged.stage(name);
}

void writeLaplacian(const std::filesystem::path& dir, const Laplacian& laplacian, const Geometry& geometry,
                    const WriteOptions& options) {
  check(laplacian, geometry);
  const Results results(laplacian, geometry, options);
  const std::vector<ResultFile> wanted = filesOf(options.formats);
  io::StagedFiles files(dir);
  io::stageFileRow(files, geometry);
  for (std::size_t w = 0; w <= wanted.size(); ++w) {
    if (options.progress && !options.progress("write", static_cast<double>(w) / static_cast<double>(wanted.size())))
      throw Cancelled("writeLaplacian: cancelled");
    if (w < wanted.size()) wanted[w].write(files.stage(wanted[w].name), results);
  }
  files.commit();
}

}  // namespace tufted
