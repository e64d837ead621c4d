#include <algorithm>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/cover_file.h"
#include "io/errors.h"
#include "io/file_text.h"
#include "io/frames_file.h"
#include "io/npy.h"
#include "io/npz_reader.h"
#include "io/promises.h"
#include "tufted/io/results.h"

namespace tufted {
namespace {

using Json = nlohmann::json;
using Path = std::filesystem::path;

SparseMatrix readMatrix(const Path& path) {
  const io::NpzReader archive(path);
  const std::string format_bytes = archive.read("format");
  const std::string_view format = io::parseNpy(format_bytes, path).values;
  const bool by_rows = format.starts_with("csr");
  if (!by_rows && !format.starts_with("csc"))
    io::refuse(path, "is a matrix of the format " + io::quote(format) + ", must be csc or csr");
  const std::vector<double> shape = archive.numbers("shape"), data = archive.numbers("data");
  const double most = std::numeric_limits<int>::max();
  if (shape.size() != 2 || shape[0] != shape[1] || !(shape[0] >= 0 && shape[0] < most))
    io::refuse(path, "holds no square matrix");
  const int n = static_cast<int>(shape[0]);
  const std::vector<int> start = io::integersOf(archive.numbers("indptr"), 0, most, path);
  const std::vector<int> indices = io::integersOf(archive.numbers("indices"), 0, n - 1.0, path);
  if (start.size() != static_cast<std::size_t>(n) + 1 || start.front() != 0 ||
      !std::is_sorted(start.begin(), start.end()) || static_cast<std::size_t>(start.back()) != indices.size() ||
      indices.size() != data.size())
    io::refuse(path, "has columns that do not fit its entries");
  SparseMatrix matrix(n, n);
  std::vector<Eigen::Triplet<double>> entries;  // in any order within a column, as scipy allows
  entries.reserve(data.size());
  for (int j = 0; j < n; ++j)
    for (int k = start[j]; k < start[j + 1]; ++k)
      entries.emplace_back(by_rows ? j : indices[k], by_rows ? indices[k] : j, data[k]);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

std::vector<double> readArray(const Path& path, std::size_t length) {
  const std::string bytes = io::readBytes(path);
  const io::NpyArray array = io::parseNpy(bytes, path);
  if (array.shape.size() != 1 || static_cast<std::size_t>(array.size()) != length)
    io::refuse(path, "is not an array of " + std::to_string(length) + " values, one for each row of L");
  return io::numbersOf(array, path);
}

/// Members of the report that algorithms and validate() look at.
void readReport(const Json& json, Report& report) {
  const auto take = [&](const char* name, auto& value) {
    using Value = std::decay_t<decltype(value)>;
    const Json member = json.value(name, Json());
    if (std::is_integral_v<Value> ? member.is_number_integer() : member.is_number()) value = member.get<Value>();
  };
  take("points", report.points);
  take("active", report.active);
  take("not_finite", report.not_finite);
  take("coincident", report.coincident);
  take("isolated", report.isolated);
  take("rim_points", report.rim_points);
  take("jump_points", report.jump_points);
  take("lost_points", report.lost_points);
  take("neighbors", report.neighbors);
  take("triangles", report.triangles);
  take("mean_edge", report.mean_edge);
  take("mean_squared_edge", report.mean_squared_edge);
  take("mollify_area", report.mollify_area);
  take("star_masses", report.star_masses);
  take("area", report.area);
  take("cover_area", report.cover_area);
  take("flips", report.flips);
  take("flip_failures", report.flip_failures);
  take("nonzeros", report.nonzeros);
  if (!json.contains("star_masses")) report.star_masses = report.active;  // of a version that did not say
  take("components", report.components);
  take("clamped_weights", report.clamped_weights);
  take("clamped_large", report.clamped_large);
  take("largest_clamped", report.largest_clamped);
}

/// Directories of before there was `kind` have the options of the build, if the command wrote them.
/// @param needed whether anything depends on it, which is the scale of the cover
Kind readKind(const Json& json, bool needed, const Path& path) {
  const Json kind = json.value("kind", Json());
  if (kind == "cloud") return Kind::cloud;
  if (kind == "mesh") return Kind::mesh;
  if (!kind.is_null()) io::refuse(path, "is of the kind " + io::quote(kind.dump()) + ", must be cloud or mesh");
  const bool of_cloud = json.contains("cloud_options"), of_mesh = json.contains("mesh_options");
  if (needed && of_cloud == of_mesh)
    io::refuse(path, "does not say of what the cover is, must have \"kind\": \"cloud\" or \"kind\": \"mesh\"");
  return of_cloud ? Kind::cloud : Laplacian().kind;
}

/// Undoes WriteOptions::dummy. Whatever else points that are not active have stays, to be found by those who check.
void removeDummies(Laplacian& laplacian) {
  laplacian.L.prune(
      [&](Eigen::Index i, Eigen::Index j, double) { return i != j || laplacian.status[i] == PointStatus::active; });
  for (std::size_t i = 0; i < laplacian.status.size(); ++i)
    if (laplacian.status[i] != PointStatus::active) laplacian.M[static_cast<Eigen::Index>(i)] = 0;
}

/// Whether the run that the report is of wrote the file: a later run into the same folder with other formats leaves the
/// matrices of the former.
bool hasWritten(const Json& written, const std::string& name) {
  const Json files = written.is_object() ? written.value("files", Json()) : Json();
  return files.is_array() && std::find(files.begin(), files.end(), name) != files.end();
}

}  // namespace

Laplacian readUncheckedLaplacian(const std::filesystem::path& dir, bool with_cover) {
  const Path report_path = dir / "report.json";
  const Json json = Json::parse(io::readBytes(report_path), nullptr, false);
  if (!json.is_object() || !json.contains("report") || !json["report"].is_object())
    io::refuse(report_path, "is no report of a Laplacian");
  const Json written = json.value("write_options", Json::object());
  for (const char* name : {"L.npz", "M.npy", "status.npy", "representative.npy", "boundary.npy", "frames.npy"})
    if (!hasWritten(written, name)) io::refuse(report_path, std::string("is of a run that did not write ") + name);
  Laplacian laplacian;
  const bool takes_cover = with_cover && hasWritten(written, "cover.npz");
  laplacian.kind = readKind(json, takes_cover, report_path);
  laplacian.L = readMatrix(dir / "L.npz");
  const auto n = static_cast<std::size_t>(laplacian.L.rows());
  const std::vector<double> mass = readArray(dir / "M.npy", n);
  laplacian.M = Eigen::Map<const VectorXd>(mass.data(), laplacian.L.rows());
  const double last = static_cast<double>(n) - 1;
  for (const int code : io::integersOf(readArray(dir / "status.npy", n), 0, 3, dir / "status.npy"))
    laplacian.status.push_back(static_cast<PointStatus>(code));
  laplacian.representative =
      io::integersOf(readArray(dir / "representative.npy", n), 0, last, dir / "representative.npy");
  for (const int code : io::integersOf(readArray(dir / "boundary.npy", n), 0, 3, dir / "boundary.npy"))
    laplacian.boundary.push_back(static_cast<Boundary>(code));
  laplacian.frames = io::readFrames(dir / "frames.npy", n);
  if (takes_cover)
    laplacian.stored_cover =
        std::make_shared<const IntrinsicTriangulation>(io::readCover(dir / "cover.npz", static_cast<int>(n)));
  readReport(json["report"], laplacian.report);
  if (written.is_object() && written.value("sign", Json()) == "igl") laplacian.L = -laplacian.L;
  if (written.is_object() && written.value("dummy", Json()) == true) removeDummies(laplacian);
  if (laplacian.report.star_masses == 0) laplacian.cover_areas = laplacian.M;
  return laplacian;
}

Laplacian readLaplacian(const std::filesystem::path& dir, bool with_cover) {
  Laplacian laplacian = readUncheckedLaplacian(dir, with_cover);
  const auto n = std::ssize(laplacian.status);
  const auto counted = laplacian.report.points;  // 0 where a program of one's own left it out
  if (counted != n && counted != 0)
    io::refuse(dir / "report.json",
               "counts " + std::to_string(counted) + " points, and L has " + std::to_string(n) + " rows");
  io::requirePromises(dir, laplacian);
  return laplacian;
}

}  // namespace tufted
