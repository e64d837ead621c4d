#include "io/report_json.h"

#include <nlohmann/json.hpp>

#include "io/result_arrays.h"
#include "io/stage_results.h"
#include "tufted/errors.h"
#include "tufted/io/results.h"
#include "tufted/version.h"

namespace tufted {
namespace {

using Json = nlohmann::ordered_json;

/// Spaces per level of nesting.
constexpr int indent = 2;

Json reportObject(const Report& report) {
  Json stages = Json::array();
  for (const StageCost& stage : report.stages)
    stages.push_back({{"name", stage.name}, {"seconds", stage.seconds}, {"bytes", stage.bytes}});
  Json json;
  visitNumbers(report, [&json](const char* name, const auto& value) { json[name] = value; });
  json["warnings"] = warnings(report);
  json["stages"] = std::move(stages);
  return json;
}

Json conventionsObject(const std::vector<io::Convention>& conventions) {
  Json json;
  for (const io::Convention& convention : conventions)
    json[Json::json_pointer("/" + convention.name)] = convention.text;
  json["status"] = {"active", "not_finite", "coincident", "isolated"};  // names by value of PointStatus
  json["boundary"] = {"none", "rim", "jump", "lost"};
  return json;
}

Json denoiseObject(const DenoiseReport& report) {
  return {
      {"points", report.points},       {"not_finite", report.not_finite},       {"coincident", report.coincident},
      {"moved", report.moved},         {"no_surface", report.no_surface},       {"sparse_share", report.sparse_share},
      {"unplaced", report.unplaced},   {"outliers", report.outliers},           {"noise", report.noise},
      {"mean_move", report.mean_move}, {"farthest_move", report.farthest_move}, {"warnings", warnings(report)},
      {"seconds", report.seconds}};
}

/// The options that clouds and meshes share.
template <class Options>
Json commonOptions(const Options& options) {
  return {{"order", options.paper.order == FaceOrder::angle  ? "angle"
                    : options.paper.order == FaceOrder::area ? "area"
                                                             : "random"},
          {"seed", options.paper.seed},
          {"mollify", options.mollify},
          {"threads", options.threads}};
}

Json optionsObject(const CloudOptions& options) {
  Json json = {{"neighbors", options.neighbors},
               {"gluing", options.paper.gluing == Gluing::star ? "star" : "vertex-pair"},
               {"delaunay", options.paper.delaunay == Delaunay::star ? "star" : "cgal"},
               {"growth", options.steps.growth == Growth::line ? "line" : "uneven"},
               {"split_sheets", options.steps.split_sheets},
               {"isolate_outliers", options.steps.isolate_outliers},
               {"star_search", options.steps.star_search == StarSearch::once ? "once" : "thorough"},
               {"filter", options.steps.filter == Filter::radius ? "radius" : "votes"},
               {"settle_diagonals", options.steps.settle_diagonals},
               {"denoise", options.steps.denoise},
               {"mass", options.steps.mass == Mass::cover ? "cover" : "star"},
               {"structure", options.structure == nullptr   ? "none"
                             : options.structure->has_rings ? "rings"
                                                            : "image"},
               {"given_normals", options.normals != nullptr},
               {"given_neighborhoods", options.neighborhoods != nullptr}};
  if (options.viewpoint != nullptr) {
    const Eigen::Vector3d& viewpoint = *options.viewpoint;
    json["viewpoint"] = {viewpoint.x(), viewpoint.y(), viewpoint.z()};
  }
  json.update(commonOptions(options));
  return json;
}

Json givenObject(const std::string& name, const std::string& text) {
  Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) throw InvalidInput("writeLaplacian: " + name + " is no JSON object");
  return json;
}

}  // namespace

std::string toJson(const DenoiseReport& report) {
  return io::jsonText(denoiseObject(report));
}

std::string toJson(const Report& report) {
  return io::jsonText(reportObject(report));
}

std::string io::jsonText(const Json& json) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string io::reportJson(const Laplacian& laplacian, const Geometry& geometry, const WriteOptions& options,
                           const std::vector<Convention>& conventions) {
  Json json = {{"tufted", TUFTED_VERSION}};
  if (!options.source.empty()) json["source"] = options.source;
  if (!options.selection.empty()) json["selection"] = givenObject("selection", options.selection);
  json["kind"] = laplacian.kind == Kind::cloud ? "cloud" : "mesh";
  if (laplacian.frames.normals.rows() > 0)
    json["orientation"] = orientation_names.at(static_cast<std::size_t>(laplacian.frames.orientation));
  json["input"] = {{"polygons", geometry.polygons}, {"merged_vertices", geometry.merged_vertices}};
  if (options.cloud) json["cloud_options"] = optionsObject(*options.cloud);
  if (options.mesh) {
    json["mesh_options"] = commonOptions(*options.mesh);
    json["mesh_options"]["weld"] = options.mesh->weld;
  }
  if (!options.cloud && !options.mesh && !options.build_options.empty())
    json[laplacian.kind == Kind::cloud ? "cloud_options" : "mesh_options"] =
        givenObject("build_options", options.build_options);
  json["write_options"] = {{"sign", options.sign == Sign::psd ? "psd" : "igl"}, {"dummy", options.dummy}};
  json["files"] = resultFiles(options.formats);
  if (fileRowOf(geometry) != nullptr) json["files"].push_back(file_row_name);
  json["conventions"] = conventionsObject(conventions);
  json["checksum"] = checksum(laplacian);
  json["report"] = reportObject(laplacian.report);
  return jsonText(json);
}

}  // namespace tufted
