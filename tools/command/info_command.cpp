#include <CLI/CLI.hpp>
#include <algorithm>
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
#include "info_text.h"
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
points that are spread over the file, or of a depth image the rows with the most points. --full looks at all points, which
takes about as long as a build. A mesh is built.
  sample        number of points that were looked at. Counts of odd points are those among them, but that of points
                that are not finite is of the whole file
  spacing       median distance to the nearest neighbour (and its 5 % and 95 % quantiles)
  float step    distance between adjacent floats at the largest coordinate; odd above a tenth of the spacing
  on lines      number of points whose nearest neighbours lie on one line, as on the rings of a scanner
  outliers      number of points whose nearest neighbour is more than five times as far away as is usual around them
  graph parts   clouds, all points: parts of the graph that joins each point with its nearest neighbours. The connected
                components of the triangles may be more or fewer; `tufted laplacian` finds them
  components    meshes: connected components
  crs           LAS: name or EPSG code of the coordinate reference system
  class         LAS: number and name of a class, and the number of its points
  structure     only for a depth image, which is built by its pixels unless --neighbors is given
  to expect     time and peak memory of `tufted laplacian FILE --out DIR`, extrapolated from a build of the sample
                (clouds), or those of the build in this run (meshes)
  odd           what to know before trusting a result, one line each: points that are not finite, coincident, ...)";

constexpr double bytes_per_triangle = 300;  ///< peak memory of a mesh that is read and built
constexpr int sample_size = 100000;         ///< points, built and described in less than a second

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
  Json info = {
      {"file", settings.input.name()}, {"format", geometry.format},  {"kind", geometry.is_mesh ? "mesh" : "cloud"},
      {"points", head.points},         {"triangles", head.faces},    {"organized", geometry.height > 1},
      {"width", geometry.width},       {"height", geometry.height},  {"viewpoint", geometry.viewpoint},
      {"normals", head.has_normals},   {"fields", std::move(fields)}};
  if (const std::string system = lasReferenceSystem(geometry); !system.empty()) info["reference_system"] = system;
  return info;
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

void addMesh(const tufted::Report& report, double seconds, Json& info) {
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

/// A sample of a large cloud or mesh, or all points of a small one.
std::vector<int> sampleOf(const tufted::Geometry& geometry, Structure structure) {
  if (geometry.points.rows() <= sample_size) {
    std::vector<int> all(geometry.points.rows());
    std::iota(all.begin(), all.end(), 0);
    return all;
  }
  return structure == Structure::image ? fullestRows(geometry, sample_size)
                                       : tufted::sampleRegions(geometry.points, sample_size);
}

/// Describes the points, and builds what shows how long a build takes. Returns why no point would be active, otherwise
/// an empty string.
std::string describePoints(const Settings& settings, const tufted::Geometry& geometry, Json& info) {
  // An image is not built by its pixels where --neighbors asks for a search.
  const Structure structure = settings.neighbors->count() == 0 ? structureFor(geometry) : Structure::none;
  const std::vector<int> sample = sampleOf(geometry, structure);
  const tufted::CloudDescription points = settings.full
                                              ? tufted::describeCloud(geometry.points, settings.cloud)
                                              : tufted::describeSample(geometry.points, sample, settings.cloud);
  addExtent(points, info);
  if (geometry.is_mesh) {
    const tufted::MeshOptions options = {.threads = settings.cloud.threads,
                                         .keep_cover = false,
                                         .weld = settings.input.weld,
                                         .progress = settings.cloud.progress};
    const BuildWatch watch;
    const tufted::Laplacian laplacian = tufted::meshLaplacian(geometry.points, geometry.triangles, options);
    addMesh(laplacian.report, watch.seconds(settings.cloud.threads), info);
    return nothingActive(laplacian);
  }
  addCloud(points, settings.cloud.neighbors, structure, info);
  addCost(expectedCost(geometry, points.points - points.not_finite, sample, structure, settings.cloud), info);
  return findNothing(settings, geometry, points);
}

int runInfo(Settings settings) {
  ProgressBar bar(settings.console.quiet);
  settings.cloud.progress = showOn(bar);
  const bool prints = !settings.console.quiet && !settings.console.json;
  const std::optional<tufted::FileHead> head = readInputHead(settings.input);
  // At once, because reading a large file takes a while.
  if (head && prints) print(infoHead(describeFile(settings, *head)).text(false));
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
  bar.follow(Plan(describeStages() + buildStages(geometry)));
  const std::string nothing = describePoints(settings, geometry, info);
  info["odd"] = findOddities(info, settings.input.weld);
  bar.clear();
  std::vector<std::string> warnings = warningsOf(settings.input.name(), geometry);
  if (!nothing.empty()) warnings.push_back(settings.input.name() + ": " + nothing);
  for (const std::string& warning : warnings) warn(bar, warning);
  info["warnings"] = warnings;
  if (prints && !head) print(infoHead(info).text(false));
  if (prints) print(infoBody(info).text(false));
  if (settings.console.json) print(textOf(info));
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
  settings->neighbors = addNumber(command, "--neighbors K", settings->cloud.neighbors, 3,
                                  std::numeric_limits<int>::max(), "Number of neighbours per point, clouds only (30)");
  addNumber(command, "--threads N", settings->cloud.threads, 1, 1 << 16,
            "Maximum number of threads (one per processor)");
  addConsole(command, settings->console);
  command.callback([&run, settings] { run = [=] { return runInfo(*settings); }; });
}
