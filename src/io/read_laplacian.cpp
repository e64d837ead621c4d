#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "io/cover_file.h"
#include "io/errors.h"
#include "io/matrix_file.h"
#include "io/npz_reader.h"
#include "io/promises.h"
#include "io/report_members.h"
#include "io/result_arrays.h"
#include "io/result_folder.h"
#include "tufted/components.h"
#include "tufted/io/results.h"

namespace tufted {
namespace {

using Path = std::filesystem::path;

Report readReport(const nlohmann::json& json, const Path& path) {
  Report report;
  visitNumbers(report, [&](const char* name, auto& value) { io::readMember(json, name, path, value); });
  if (!json.contains("star_masses")) report.star_masses = report.active;  // versions without this member
  for (const nlohmann::json& stage : json.value("stages", nlohmann::json::array())) {
    if (!stage.is_object()) io::refuse(path, "has a stage that is no object");
    StageCost& cost = report.stages.emplace_back();
    if (const nlohmann::json name = stage.value("name", nlohmann::json()); name.is_string())
      cost.name = name.get<std::string>();
    io::readMember(stage, "seconds", path, cost.seconds);
    io::readMember(stage, "bytes", path, cost.bytes);
  }
  return report;
}

/// Reads the kind, which in reports of older versions follows from the options of the build, if present.
/// @param needed whether an unknown kind is an error, because the scale of the cover depends on it
Kind readKind(const nlohmann::json& json, bool needed, const Path& path) {
  const nlohmann::json kind = json.value("kind", nlohmann::json());
  if (kind == "cloud") return Kind::cloud;
  if (kind == "mesh") return Kind::mesh;
  if (!kind.is_null()) io::refuse(path, "is of the kind " + io::quote(kind.dump()) + ", must be cloud or mesh");
  const bool of_cloud = json.contains("cloud_options"), of_mesh = json.contains("mesh_options");
  if (needed && of_cloud == of_mesh)
    io::refuse(path, "does not say of what the cover is, must have \"kind\": \"cloud\" or \"kind\": \"mesh\"");
  return of_cloud ? Kind::cloud : Laplacian().kind;
}

/// Reads the orientation of the frames; arbitrary in reports of older versions.
Orientation readOrientation(const nlohmann::json& json, const Path& path) {
  const nlohmann::json orientation = json.value("orientation", nlohmann::json());
  if (orientation.is_null()) return Orientation::arbitrary;
  for (std::size_t k = 0; k < io::orientation_names.size(); ++k)
    if (orientation == io::orientation_names[k]) return static_cast<Orientation>(k);
  io::refuse(path, "has the orientation " + io::quote(orientation.dump()) +
                       ", must be arbitrary, given, viewpoint or consistent");
}

constexpr const char* noise_name = "noise.npy";

/// Undoes WriteOptions::dummy. Other entries of points that are not active are kept, so that validation can report
/// them.
void removeDummies(Laplacian& laplacian) {
  laplacian.L.prune(
      [&](Eigen::Index i, Eigen::Index j, double) { return i != j || laplacian.status[i] == PointStatus::active; });
  for (std::size_t i = 0; i < laplacian.status.size(); ++i)
    if (laplacian.status[i] != PointStatus::active) laplacian.M[static_cast<Eigen::Index>(i)] = 0;
}

/// Reads the edges of each component. Older versions wrote only those of the whole surface, into the report.
/// @param laplacian with components and report
std::vector<ComponentEdges> readEdges(const io::ResultFolder& folder, const Laplacian& laplacian) {
  const std::size_t components = componentSizes(laplacian.component).size();
  if (folder.has(io::component_edges_name))
    return io::readComponentEdges(folder.pathOf(io::component_edges_name), components);
  const Report& report = laplacian.report;
  if (!(report.mean_squared_edge > 0)) return {};
  return {components, {1, report.mean_edge, report.mean_squared_edge}};
}

}  // namespace

Laplacian readUncheckedLaplacian(const std::filesystem::path& dir, bool with_cover) {
  const io::ResultFolder folder(dir);
  const Path report_path = folder.reportPath();
  const nlohmann::json& json = folder.report();
  if (!json.contains("report") || !json["report"].is_object()) io::refuse(report_path, "is no report of a Laplacian");
  const Path matrix_path = folder.pathOf("L.npz"), mass_path = folder.pathOf("M.npy"),
             status_path = folder.pathOf("status.npy"), representative_path = folder.pathOf("representative.npy"),
             boundary_path = folder.pathOf("boundary.npy"), frames_path = folder.pathOf("frames.npy");
  Laplacian laplacian;
  const bool takes_cover = with_cover && folder.has("cover.npz");
  laplacian.kind = readKind(json, takes_cover, report_path);
  laplacian.report = readReport(json["report"], report_path);
  // Arrays with a value per point are not compressed, so their size bounds the number of rows that L may have.
  io::MatrixFile matrix(matrix_path);
  const auto n = static_cast<std::size_t>(matrix.rows());
  const std::vector<double> mass = io::readValues(mass_path, n);
  laplacian.M = Eigen::Map<const VectorXd>(mass.data(), matrix.rows());
  const double last = static_cast<double>(n) - 1;
  for (const int code : io::integersOf(io::readValues(status_path, n), 0, 3, status_path))
    laplacian.status.push_back(static_cast<PointStatus>(code));
  laplacian.representative = io::integersOf(io::readValues(representative_path, n), 0, last, representative_path);
  for (const int code : io::integersOf(io::readValues(boundary_path, n), 0, 3, boundary_path))
    laplacian.boundary.push_back(static_cast<Boundary>(code));
  laplacian.frames = io::readFrames(frames_path, n);
  laplacian.frames.orientation = readOrientation(json, report_path);
  // Older versions did not write these files.
  if (folder.has(io::positions_name)) laplacian.positions = io::readPositions(folder.pathOf(io::positions_name), n);
  if (folder.has(noise_name)) laplacian.noise = io::readNoise(folder.pathOf(noise_name), n);
  laplacian.L = matrix.read();
  if (takes_cover) laplacian.setCover(io::readCover(folder.pathOf("cover.npz"), static_cast<int>(n)));
  const nlohmann::json written = json.value("write_options", nlohmann::json::object());
  if (written.is_object() && written.value("sign", nlohmann::json()) == "igl") laplacian.L = -laplacian.L;
  if (written.is_object() && written.value("dummy", nlohmann::json()) == true) removeDummies(laplacian);
  if (laplacian.report.star_masses == 0) laplacian.cover_areas = laplacian.M;
  return laplacian;
}

Laplacian readLaplacian(const std::filesystem::path& dir, bool with_cover) {
  Laplacian laplacian = readUncheckedLaplacian(dir, with_cover);
  const auto n = std::ssize(laplacian.status);
  const auto counted = laplacian.report.points;  // 0 if another program wrote the report without it
  if (counted != n && counted != 0)
    io::refuse(dir / io::report_name,
               "counts " + std::to_string(counted) + " points, and L has " + std::to_string(n) + " rows");
  io::requirePromises(dir, laplacian);
  laplacian.component = componentLabels(laplacian);
  laplacian.component_edges = readEdges(io::ResultFolder(dir), laplacian);
  return laplacian;
}

}  // namespace tufted
