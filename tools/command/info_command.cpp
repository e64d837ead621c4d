#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "command.h"
#include "console.h"
#include "expected_cost.h"
#include "input.h"
#include "interrupt.h"
#include "las_classes.h"
#include "options.h"
#include "progress_bar.h"
#include "structure.h"
#include "tufted/describe.h"
#include "tufted/errors.h"
#include "tufted/laplacian.h"
#include "warnings.h"

namespace info_command {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* description =
    "Describe a file, list what is odd about it, and estimate the cost of building L and M.";

constexpr const char* footer =
    R"(Examples:
  tufted info scan.ply
  tufted info scan.ply --json

Nothing is written. Of a cloud of more than 100,000 points only a sample is looked at: the points of eight balls around
points that are spread over the file, or the middle rows of a depth image. --full looks at all points, which takes about
as long as a build. A mesh is built.
  sample        number of points that were looked at. Counts of odd points are those among them, but that of points
                that are not finite is of the whole file
  spacing       median distance to the nearest neighbour (and its 5 % and 95 % quantiles)
  float step    distance between adjacent floats at the largest coordinate; odd above a tenth of the spacing
  on lines      number of points whose nearest neighbours lie on one line, as on the rings of a scanner
  outliers      number of points whose nearest neighbour is more than five times as far away as is usual around them
  graph parts   clouds, all points: parts of the graph that joins each point with its nearest neighbours. The connected
                components of the triangles may be more or fewer; `tufted laplacian` finds them
  components    meshes: connected components
  class         LAS: number and name of a class, and the number of its points
  structure     only for a depth image, which is built by its pixels unless --neighbors is given
  to expect     time and peak memory of `tufted laplacian FILE --out DIR`, extrapolated from a build of the sample
                (clouds), or those of the build in this run (meshes)
  odd           what to know before trusting a result, one line each: points that are not finite, coincident, ...)";

constexpr double bytes_per_triangle = 300;  ///< peak memory of a mesh that is read and built
constexpr int sample_size = 100000;         ///< points, built and described in less than a second
constexpr double coarse_step = 0.1;         ///< float steps above this many spacings move points visibly

struct Settings {
  Input input;
  bool full = false;  ///< whether to look at all points of a large cloud
  tufted::CloudOptions cloud;
  CLI::Option* neighbors = nullptr;  ///< --neighbors
  Console console;
};

const char* typeName(tufted::FieldType type) {
  constexpr const char* names[] = {"int8",   "uint8", "int16",  "uint16",  "int32",
                                   "uint32", "int64", "uint64", "float32", "float64"};
  return names[static_cast<int>(type)];
}

template <class Vector>
Json array(const Vector& values) {
  return Json(std::vector<double>(values.begin(), values.end()));
}

/// Describes what the head says, and of a file without one what was read.
Json describeFile(const Settings& settings, const tufted::FileHead& head) {
  const tufted::Geometry& geometry = head.geometry;
  Json fields = Json::array();
  for (const tufted::Field& field : geometry.fields)
    fields.push_back({{"name", field.name}, {"type", typeName(field.type)}, {"count", field.count}});
  return {{"file", settings.input.name()}, {"format", geometry.format},  {"kind", geometry.is_mesh ? "mesh" : "cloud"},
          {"points", head.points},         {"triangles", head.faces},    {"organized", geometry.height > 1},
          {"width", geometry.width},       {"height", geometry.height},  {"viewpoint", geometry.viewpoint},
          {"normals", head.has_normals},   {"fields", std::move(fields)}};
}

/// Adds what only shows when the file is read.
void addContent(const tufted::Geometry& geometry, Json& info) {
  info["triangles"] = geometry.triangles.rows();
  info["polygons"] = geometry.polygons;
  info["merged_vertices"] = geometry.merged_vertices;
  info["unread_bytes"] = geometry.unread_bytes;
  for (const LasClass& each : lasClasses(geometry))
    info["classes"].push_back({{"number", each.number}, {"name", each.name}, {"points", each.points}});
}

/// Adds what clouds and meshes share.
void addExtent(const tufted::CloudDescription& points, Json& info) {
  info["lowest"] = array(points.lowest);
  info["highest"] = array(points.highest);
  info["spacing"] = points.spacing;
  info["spacing_low"] = points.spacing_low;
  info["spacing_high"] = points.spacing_high;
  info["float_step"] = points.float_step;
  info["sampled"] = points.sampled;
  info["not_finite"] = points.not_finite;
  info["coincident"] = points.coincident;
}

/// Adds what is known of a cloud, with `asked` neighbours per point and the structure that a build would use.
void addCloud(const tufted::CloudDescription& cloud, int asked, Structure structure, Json& info) {
  info["neighbors"] = cloud.neighbors;
  info["neighbors_clamped"] = cloud.neighbors < asked;
  info["on_lines"] = cloud.on_lines;
  info["outliers"] = cloud.outliers;
  if (cloud.sampled == cloud.points) info["graph_parts"] = cloud.components;
  info["structure"] = nameOf(structure);
}

void addCost(const ExpectedCost& cost, Json& info) {
  info["expected_seconds"] = cost.seconds;
  info["expected_bytes"] = cost.bytes;
}

void addMesh(const tufted::Report& report, Json& info) {
  double seconds = 0;
  for (const tufted::StageCost& stage : report.stages) seconds += stage.seconds;
  info["mean_edge"] = report.mean_edge;
  info["isolated"] = report.isolated;
  info["repeated_vertex_triangles"] = report.repeated_vertex_triangles;
  info["not_finite_triangles"] = report.not_finite_triangles;
  info["degenerate_faces"] = report.degenerate_faces;
  info["boundary_edges"] = report.boundary_edges;
  info["nonmanifold_edges"] = report.nonmanifold_edges;
  info["components"] = report.components;
  addCost(withFiles(seconds, static_cast<double>(report.triangles) * bytes_per_triangle,
                    static_cast<double>(report.points)),
          info);
}

/// One sentence for each oddity that a user should know before trusting a result.
std::vector<std::string> findOddities(const Json& info, bool joins_equal) {
  std::vector<std::string> odd;
  const std::string of_sample = info["sampled"] == info["points"]
                                    ? ""
                                    : " of " + std::to_string(info["sampled"].get<std::int64_t>()) + " looked at";
  const auto add = [&](const char* member, const char* text, const std::string& tail = "") {
    if (info.contains(member) && info[member].get<std::int64_t>() > 0)
      odd.push_back(std::string(text) + ": " + std::to_string(info[member].get<std::int64_t>()) + tail);
  };
  if (info["points"] == 0) odd.emplace_back("the file holds no points");
  add("not_finite", "points that are not finite and take no part");
  add("coincident",
      info["kind"] == "cloud" ? "points that equal an earlier one and take no part"
      : joins_equal           ? "vertices that equal an earlier one, which stands for them"
                              : "vertices that equal another one and stay separate (--weld joins them)",
      of_sample);
  add("outliers",
      "points whose nearest neighbour is five times as far as is usual around them; most take part all the same",
      of_sample);
  add("isolated", "vertices without a triangle");
  add("repeated_vertex_triangles", "triangles that name a vertex twice and are dropped");
  add("not_finite_triangles", "triangles with a vertex that is not finite, which are dropped");
  add("degenerate_faces", "faces without area");
  add("nonmanifold_edges", "edges of more than two triangles");
  if (info.contains("on_lines") && info["on_lines"].get<double>() > 0.05 * info["sampled"].get<double>())
    add("on_lines", "points whose neighbours lie on one line, as on the rings of a spinning scanner", of_sample);
  const double spacing = info["spacing"].get<double>(), step = info["float_step"].get<double>();
  if (std::isinf(step))
    odd.push_back("coordinates beyond the range of floats");
  else if (spacing > 0 && step > coarse_step * spacing)
    odd.push_back("so far from the origin that floats would move points by up to " +
                  std::to_string(step / 2 / spacing) + " of the spacing");
  return odd;
}

void printTriple(const char* name, const Json& values) {
  std::printf("%-15s %.10g %.10g %.10g\n", name, values[0].get<double>(), values[1].get<double>(),
              values[2].get<double>());
}

void printFields(const Json& info) {
  std::string names = info["normals"] ? "normals" : "";
  for (const Json& field : info["fields"]) {
    const int count = field["count"].get<int>();
    names += (names.empty() ? "" : ", ") + field["name"].get<std::string>() + " " + field["type"].get<std::string>() +
             (count > 1 ? " x " + std::to_string(count) : "");
  }
  if (!names.empty()) std::printf("%-15s %s\n", "fields", names.c_str());
}

long long integer(const Json& info, const char* member) {
  return static_cast<long long>(info[member].get<std::int64_t>());
}

double real(const Json& info, const char* member) {
  return info[member].get<double>();
}

/// Prints what the head of a file says, at once, because reading a large file takes a while.
void printHead(const Json& info) {
  std::printf("%-15s %s (%s)\n", "file", info["file"].get<std::string>().c_str(),
              info["kind"].get<std::string>().c_str());
  std::printf("%-15s %s\n", "format", info["format"].get<std::string>().c_str());
  std::printf("%-15s %lld", "points", integer(info, "points"));
  if (info["organized"]) std::printf(", organized %lld x %lld", integer(info, "width"), integer(info, "height"));
  if (info["kind"] == "mesh") std::printf("; %lld faces", integer(info, "triangles"));
  std::printf("\n");
  printFields(info);
  if (info["viewpoint"] != Json(tufted::Geometry().viewpoint))
    std::printf("%-15s %s\n", "viewpoint", info["viewpoint"].dump().c_str());
  std::fflush(stdout);
}

void printContent(const Json& info) {
  const bool is_mesh = info["kind"] == "mesh";
  if (is_mesh)
    std::printf("%-15s %lld, %lld polygons triangulated\n", "triangles", integer(info, "triangles"),
                integer(info, "polygons"));
  if (integer(info, "merged_vertices") > 0)
    std::printf("%-15s %lld equal corners\n", "merged", integer(info, "merged_vertices"));
  if (info.contains("selection"))
    std::printf("%-15s %lld of %lld points, which the rest describes\n", "chosen", integer(info["selection"], "kept"),
                integer(info["selection"], "points"));
  if (info.contains("classes"))
    for (const Json& each : info["classes"])
      std::printf("%-15s %lld %s, %lld points\n", "class", integer(each, "number"),
                  each["name"].get<std::string>().c_str(), integer(each, "points"));
  printTriple("lowest", info["lowest"]);
  printTriple("highest", info["highest"]);
  if (integer(info, "sampled") < integer(info, "points"))
    std::printf("%-15s %lld points; --full looks at all\n", "sample", integer(info, "sampled"));
  std::printf("%-15s %.4g (%.4g to %.4g)\n", "spacing", real(info, "spacing"), real(info, "spacing_low"),
              real(info, "spacing_high"));
  std::printf("%-15s %.4g\n", "float step", real(info, "float_step"));
  if (is_mesh) {
    std::printf("%-15s %.4g\n", "mean edge", real(info, "mean_edge"));
    std::printf("%-15s %lld boundary, %lld nonmanifold\n", "edges", integer(info, "boundary_edges"),
                integer(info, "nonmanifold_edges"));
  }
  if (info.value("neighbors_clamped", false))
    std::printf("%-15s %lld, all other points\n", "neighbors", integer(info, "neighbors"));
  for (const auto& [member, name] : {std::pair("components", "components"), std::pair("graph_parts", "graph parts")})
    if (info.contains(member)) std::printf("%-15s %lld\n", name, integer(info, member));
  if (info.value("structure", "") == nameOf(Structure::image))
    std::printf("%-15s %s\n", "structure", "depth image, built by its pixels");
  for (const Json& sentence : info["odd"]) std::printf("%-15s %s\n", "odd", sentence.get<std::string>().c_str());
  std::printf("%-15s %.2g s, %.0f MB\n", "to expect", real(info, "expected_seconds"),
              real(info, "expected_bytes") / 1e6);
}

/// Explains why no point would be active; otherwise an empty string. Builds a cloud only if that is possible.
std::string findNothing(const Settings& settings, const tufted::Geometry& geometry,
                        const tufted::CloudDescription& cloud) {
  // Points that are not finite are counted in the whole cloud, and are not in a sample.
  const bool is_whole = cloud.sampled == cloud.points;
  const std::int64_t usable = cloud.sampled - cloud.coincident - (is_whole ? cloud.not_finite : 0);
  if (usable >= 3 && cloud.on_lines < usable) return "";
  tufted::CloudOptions options = settings.cloud;
  options.keep_cover = false;
  return nothingActive(tufted::pointCloudLaplacian(geometry.points, options));
}

/// The points of a cloud or mesh that are looked at: all, or a sample of a large file.
std::vector<int> sampleOf(const Settings& settings, const tufted::Geometry& geometry, Structure structure) {
  if (settings.full || geometry.points.rows() <= sample_size) {
    std::vector<int> all(geometry.points.rows());
    std::iota(all.begin(), all.end(), 0);
    return all;
  }
  return structure == Structure::image ? middleRows(geometry, sample_size)
                                       : tufted::sampleRegions(geometry.points, sample_size);
}

/// Describes the points, and builds what shows how long a build takes. Returns why no point would be active, otherwise
/// an empty string.
std::string describePoints(const Settings& settings, const tufted::Geometry& geometry, Json& info) {
  // As in a build, --neighbors asks for a search.
  const Structure structure = settings.neighbors->count() == 0 ? structureFor(geometry) : Structure::none;
  const tufted::CloudDescription points =
      tufted::describeSample(geometry.points, sampleOf(settings, geometry, structure), settings.cloud);
  addExtent(points, info);
  if (geometry.is_mesh) {
    const tufted::MeshOptions options = {.threads = settings.cloud.threads,
                                         .keep_cover = false,
                                         .weld = settings.input.weld,
                                         .progress = settings.cloud.progress};
    const tufted::Laplacian laplacian = tufted::meshLaplacian(geometry.points, geometry.triangles, options);
    addMesh(laplacian.report, info);
    return nothingActive(laplacian);
  }
  addCloud(points, settings.cloud.neighbors, structure, info);
  Settings sampling = settings;
  sampling.full = false;
  addCost(expectedCost(geometry, sampleOf(sampling, geometry, structure), structure, settings.cloud), info);
  return findNothing(settings, geometry, points);
}

int runInfo(Settings settings) {
  ProgressBar bar(settings.console.quiet);
  settings.cloud.progress = showOn(bar);
  const bool prints = !settings.console.quiet && !settings.console.json;
  const std::optional<tufted::FileHead> head = readInputHead(settings.input);
  if (head && prints) printHead(describeFile(settings, *head));
  settings.cloud.progress("read", 0);
  tufted::FileHead file;
  file.geometry = readInput(settings.input, settings.cloud.progress);
  if (interrupted()) throw tufted::Cancelled("cancelled");
  const tufted::Geometry& geometry = file.geometry;
  file.points = geometry.points.rows();
  file.faces = geometry.triangles.rows();
  file.has_normals = geometry.normals.rows() > 0;
  Json info = describeFile(settings, file);
  addContent(geometry, info);
  if (settings.input.chosen.of > 0) info["selection"] = settings.input.chosen.json();
  const std::string nothing = describePoints(settings, geometry, info);
  info["odd"] = findOddities(info, settings.input.weld);
  bar.clear();
  std::vector<std::string> warnings = geometry.notes;
  if (!nothing.empty()) warnings.push_back(settings.input.name() + ": " + nothing);
  for (const std::string& warning : warnings) warn(bar, warning);
  info["warnings"] = warnings;
  if (prints && !head) printHead(info);
  if (prints) printContent(info);
  if (settings.console.json) std::printf("%s\n", info.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
  if (std::fflush(stdout) != 0) throw tufted::IoError("standard output: cannot be written");
  return exit_done;
}

}  // namespace
}  // namespace info_command

void addInfo(CLI::App& app, Run& run) {
  using namespace info_command;
  CLI::App& command = *app.add_subcommand("info", description);
  command.footer(footer);
  const auto settings = std::make_shared<Settings>();
  addInput(command, settings->input);
  addWeld(command, settings->input);
  command.add_flag("--full", settings->full, "Look at all points, not at a sample of 100,000 of a larger file");
  settings->neighbors = addNumber(command, "--neighbors", settings->cloud.neighbors, 3, std::numeric_limits<int>::max(),
                                  "Number of neighbours per point, clouds only (30)")
                            ->type_name("K");
  addNumber(command, "--threads", settings->cloud.threads, 1, 1 << 16, "Maximum number of threads (one per processor)")
      ->type_name("N");
  addConsole(command, settings->console);
  command.callback([&run, settings] { run = [=] { return runInfo(*settings); }; });
}
