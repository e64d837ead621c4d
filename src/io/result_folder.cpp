#include "io/result_folder.h"

#include <algorithm>

#include "io/errors.h"
#include "io/file_text.h"
#include "io/report_members.h"
#include "tufted/io/head.h"
#include "tufted/io/results.h"

namespace tufted {

namespace io {
namespace {

/// Reads a file of JSON, discarded if it is none. The depth of nesting is bounded, because copying and printing values
/// recurse.
nlohmann::json readJson(const std::filesystem::path& path) {
  using Json = nlohmann::json;
  // Most levels of nesting: our own files have four, and deep recursion would crash the process.
  constexpr int most = 32;
  const auto check = [&path](int depth, Json::parse_event_t, const Json&) {
    if (depth > most) refuse(path, "is nested deeper than " + std::to_string(most) + " levels");
    return true;
  };
  return Json::parse(readBytes(path), check, false);
}

}  // namespace

ResultFolder::ResultFolder(const std::filesystem::path& dir) : dir_(dir), report_(readJson(dir / report_name)) {
  if (!report_.is_object()) refuse(reportPath(), "is no report of a result");
  // Older versions listed a Laplacian's files in `write_options`.
  nlohmann::json list = report_.value("files", nlohmann::json());
  const nlohmann::json written = report_.value("write_options", nlohmann::json());
  if (list.is_null() && written.is_object()) list = written.value("files", nlohmann::json());
  is_listed_ = list.is_array();
  for (const nlohmann::json& name : list)
    if (name.is_string()) files_.push_back(name.get<std::string>());
}

const std::vector<std::string>& ResultFolder::files() const {
  if (!is_listed_) refuse(reportPath(), "does not list the files of its result, must have them as \"files\"");
  return files_;
}

bool ResultFolder::has(const std::string& name) const {
  return std::find(files().begin(), files().end(), name) != files().end();
}

std::filesystem::path ResultFolder::pathOf(const std::string& name) const {
  if (!has(name)) refuse(reportPath(), "is of a run that did not write " + name);
  return dir_ / name;
}

}  // namespace io

std::vector<std::string> filesOfResult(const std::filesystem::path& dir) {
  return io::ResultFolder(dir).files();
}

Geometry readPoints(const std::filesystem::path& dir, const Progress& progress) {
  const io::ResultFolder folder(dir);
  const nlohmann::json kind = folder.report().value("kind", nlohmann::json());
  // For clouds PCD is preferred, which keeps all fields; for meshes PLY, which has triangles.
  std::vector<std::string> names = {"points.ply", "points.pcd", "points.las"};
  if (kind == "cloud") std::swap(names[0], names[1]);
  const auto name = std::find_if(names.begin(), names.end(), [&](const std::string& each) { return folder.has(each); });
  if (name == names.end()) return {};
  Geometry geometry =
      read(dir / *name, kind == "cloud" ? ReadAs::cloud : ReadAs::automatic, FileFormat::automatic, progress);
  if (const char* const las = "points.las"; *name != las && folder.has(las)) {
    if (const auto head = readHead(dir / las)) geometry.las_header = head->geometry.las_header;
  }
  // A mesh without a face reads as a cloud.
  if (kind == "mesh" && *name == "points.ply") geometry.is_mesh = true;
  const nlohmann::json input = folder.report().value("input", nlohmann::json());
  io::readMember(input, "polygons", folder.reportPath(), geometry.polygons);
  io::readMember(input, "merged_vertices", folder.reportPath(), geometry.merged_vertices);
  return geometry;
}

}  // namespace tufted
