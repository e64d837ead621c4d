#include "tufted/io/write.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "io/columns.h"
#include "io/component_edges_file.h"
#include "io/conventions.h"
#include "io/cover_file.h"
#include "io/frames_file.h"
#include "io/las_writer.h"
#include "io/mat.h"
#include "io/matrix_petsc.h"
#include "io/matrix_text.h"
#include "io/npy.h"
#include "io/npz.h"
#include "io/output_file.h"
#include "io/output_matrices.h"
#include "io/pcd_writer.h"
#include "io/ply_writer.h"
#include "io/pose.h"
#include "io/positions_file.h"
#include "io/report_json.h"
#include "io/result_folder.h"
#include "io/stage_results.h"
#include "io/staged_files.h"
#include "tufted/components.h"
#include "tufted/errors.h"
#include "tufted/surface_triangles.h"

namespace tufted {
namespace {

using io::OutputPath;

/// What the files are written from.
struct Results {
  const Laplacian& laplacian;
  const Geometry& geometry;
  const WriteOptions& options;
  io::OutputMatrices matrices = {laplacian, options};
  std::vector<io::Convention> conventions = io::conventions(laplacian, options);
};

template <class T>
void writeNpy(const OutputPath& to, const char* descr, const T* values, std::size_t length) {
  io::OutputFile file(to);
  file.write(io::npyHeader(descr, {static_cast<std::int64_t>(length)}));
  file.write(values, length * sizeof(T));
  file.close();
}

void writeReport(const OutputPath& to, const Results& results) {
  io::OutputFile file(to);
  file.write(io::reportJson(results.laplacian, results.geometry, results.options, results.conventions));
  file.close();
}

struct ResultFile {
  std::optional<Format> format;  ///< nullopt: always written
  const char* name;
  void (*write)(const OutputPath& to, const Results& results);
};

const ResultFile result_files[] = {
    {Format::npz, "L.npz", [](const OutputPath& to, const Results& r) { io::writeNpz(to, r.matrices.matrix()); }},
    {Format::npz, "M.npy",
     [](const OutputPath& to, const Results& r) {
       writeNpy(to, "<f8", r.matrices.masses().data(), r.laplacian.status.size());
     }},
    {Format::npz, "status.npy",
     [](const OutputPath& to, const Results& r) {
       writeNpy(to, "|u1", r.laplacian.status.data(), r.laplacian.status.size());
     }},
    {Format::npz, "representative.npy",
     [](const OutputPath& to, const Results& r) {
       writeNpy(to, "<i4", r.laplacian.representative.data(), r.laplacian.representative.size());
     }},
    {Format::npz, "boundary.npy",
     [](const OutputPath& to, const Results& r) {
       writeNpy(to, "|u1", r.laplacian.boundary.data(), r.laplacian.boundary.size());
     }},
    {Format::npz, "frames.npy",
     [](const OutputPath& to, const Results& r) { io::writeFrames(to, r.laplacian.frames); }},
    {Format::npz, "noise.npy",
     [](const OutputPath& to, const Results& r) {
       writeNpy(to, "<f8", r.laplacian.noise.data(), static_cast<std::size_t>(r.laplacian.noise.size()));
     }},
    {Format::npz, io::component_edges_name,
     [](const OutputPath& to, const Results& r) { io::writeComponentEdges(to, r.laplacian.component_edges); }},
    {Format::cover, "cover.npz",
     [](const OutputPath& to, const Results& r) { io::writeCover(to, r.laplacian.cover()); }},
    {Format::mtx, "L.mtx",
     [](const OutputPath& to, const Results& r) { io::writeMtx(to, r.matrices.matrix(), r.conventions); }},
    {Format::mtx, "M.mtx",
     [](const OutputPath& to, const Results& r) { io::writeMtx(to, r.matrices.masses(), r.conventions); }},
    {Format::mat, "laplacian.mat",
     [](const OutputPath& to, const Results& r) {
       io::writeMat(to, r.matrices.matrix(), r.matrices.masses(), r.laplacian, r.conventions);
     }},
    {Format::spmat, "L.spmat", [](const OutputPath& to, const Results& r) { io::writeSpmat(to, r.matrices.matrix()); }},
    {Format::spmat, "M.spmat", [](const OutputPath& to, const Results& r) { io::writeSpmat(to, r.matrices.masses()); }},
    {Format::petsc, "L.petsc", [](const OutputPath& to, const Results& r) { io::writePetsc(to, r.matrices.matrix()); }},
    {Format::petsc, "M.petsc", [](const OutputPath& to, const Results& r) { io::writePetsc(to, r.matrices.masses()); }},
    {Format::ply, "points.ply",
     [](const OutputPath& to, const Results& r) {
       io::writePly(to, r.laplacian, r.geometry, r.matrices.masses(), r.conventions);
     }},
    {Format::pcd, "points.pcd",
     [](const OutputPath& to, const Results& r) {
       io::writePcd(to, r.laplacian, r.geometry, r.matrices.masses(), r.conventions);
     }},
    {Format::las, "points.las",
     [](const OutputPath& to, const Results& r) { io::writeLas(to, r.laplacian, r.geometry, r.matrices.masses()); }},
    {Format::triangles, "triangles.ply",
     [](const OutputPath& to, const Results& r) {
       Geometry surface = r.geometry;
       if (r.laplacian.positions.rows() > 0) surface.points = r.laplacian.positions;
       if (!surface.is_mesh) surface.triangles = surfaceTriangles(r.laplacian);
       surface.is_mesh = true;
       surface.width = surface.height = 0;
       io::writePly(to, r.laplacian, surface, r.matrices.masses(), r.conventions);
     }},
    {std::nullopt, io::positions_name,
     [](const OutputPath& to, const Results& r) { io::writePositions(to, r.laplacian.positions); }},
    {std::nullopt, "components.npy",
     [](const OutputPath& to, const Results& r) {
       // Computed only here, after earlier formats have refused an L that is too large for them.
       const Laplacian& laplacian = r.laplacian;
       const std::vector<int> component =
           laplacian.component.empty() ? componentLabels(laplacian) : laplacian.component;
       writeNpy(to, "<i4", component.data(), component.size());
     }},
    {std::nullopt, io::report_name, writeReport},
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
  const Results results = {laplacian, geometry, options};
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
