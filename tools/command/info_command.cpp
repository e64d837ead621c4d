#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "command.h"
#include "console.h"
#include "input.h"
#include "interrupt.h"
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

Nothing is written. Of a cloud only the nearest neighbours are found. A mesh is built, and so is a cloud of one or two
points or with all points on lines, because only the build shows whether any of its points is active.
  spacing       median distance to the nearest neighbour (and its 5 % and 95 % quantiles)
  float step    distance between adjacent floats at the largest coordinate; odd above a tenth of the spacing
  on lines      number of points whose nearest neighbours lie on one line, as on the rings of a scanner
  outliers      number of points whose nearest neighbour is more than five times as far away as is usual around them
  graph parts   clouds: parts of the graph that joins each point with its nearest neighbours. The connected components
                of the triangles may be more or fewer; `tufted laplacian` finds them
  components    meshes: connected components
  structure     only for a depth image, which is built by its pixels unless --neighbors is given
  to expect     time and memory of a build. The time is estimated from that of the search (clouds) or of the build
                (meshes) in this run, the memory is 1 kB per point, or 0.5 kB per pixel or triangle
  odd           what to know before trusting a result, one line each: points that are not finite, coincident, ...)";

// Time of a build in units of the search for neighbours, and its peak memory per point in bytes, by tufted_bench.
constexpr double build_over_search = 3.5;
constexpr double bytes_per_point = 1000;
// The same for depth images, which need no search. Five images of 640 x 480 pixels took 0.4 to 1.2 of the time of a
// search, and 360 to 470 bytes per point.
constexpr double pixels_over_search = 0.8;
constexpr double bytes_per_pixel = 500;
constexpr double coarse_step = 0.1;  ///< float steps above this many spacings move points visibly

struct Settings {
  Input input;
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

Json describeFile(const Settings& settings, const tufted::Geometry& geometry) {
  Json fields = Json::array();
  for (const tufted::Field& field : geometry.fields)
    fields.push_back({{"name", field.name}, {"type", typeName(field.type)}, {"count", field.count}});
  Json file = {{"file", settings.input.name()},
               {"format", geometry.format},
               {"kind", geometry.is_mesh ? "mesh" : "cloud"},
               {"points", geometry.points.rows()},
               {"triangles", geometry.triangles.rows()},
               {"polygons", geometry.polygons},
               {"merged_vertices", geometry.merged_vertices},
               {"unread_bytes", geometry.unread_bytes},
               {"organized", geometry.height > 1},
               {"width", geometry.width},
               {"height", geometry.height},
               {"viewpoint", geometry.viewpoint},
               {"normals", geometry.normals.rows() > 0},
               {"fields", std::move(fields)}};
  return file;
}

/// Adds what clouds and meshes share.
void addExtent(const tufted::CloudDescription& points, Json& info) {
  info["lowest"] = array(points.lowest);
  info["highest"] = array(points.highest);
  info["spacing"] = points.spacing;
  info["spacing_low"] = points.spacing_low;
  info["spacing_high"] = points.spacing_high;
  info["float_step"] = points.float_step;
  info["not_finite"] = points.not_finite;
  info["coincident"] = points.coincident;
}

/// Adds what is known of a cloud, with `asked` neighbours per point and the structure that a build would use.
void addCloud(const tufted::CloudDescription& cloud, int asked, Structure structure, Json& info) {
  const bool is_image = structure == Structure::image;
  info["neighbors"] = cloud.neighbors;
  info["neighbors_clamped"] = cloud.neighbors < asked;
  info["on_lines"] = cloud.on_lines;
  info["outliers"] = cloud.outliers;
  info["graph_parts"] = cloud.components;
  info["structure"] = nameOf(structure);
  info["expected_seconds"] = cloud.seconds * (is_image ? pixels_over_search : build_over_search);
  info["expected_bytes"] = static_cast<double>(cloud.points) * (is_image ? bytes_per_pixel : bytes_per_point);
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
  info["expected_seconds"] = seconds;
  info["expected_bytes"] = static_cast<double>(report.triangles) * bytes_per_point / 2;
}

/// One sentence for each oddity that a user should know before trusting a result.
std::vector<std::string> findOddities(const Json& info, bool joins_equal) {
  std::vector<std::string> odd;
  const auto add = [&](const char* member, const char* text) {
    if (info.contains(member) && info[member].get<std::int64_t>() > 0)
      odd.push_back(std::string(text) + ": " + std::to_string(info[member].get<std::int64_t>()));
  };
  if (info["points"] == 0) odd.emplace_back("the file holds no points");
  add("not_finite", "points that are not finite and take no part");
  add("coincident", info["kind"] == "cloud" ? "points that equal an earlier one and take no part"
                    : joins_equal           ? "vertices that equal an earlier one, which stands for them"
                                            : "vertices that equal another one and stay separate (--weld joins them)");
  add("outliers",
      "points whose nearest neighbour is five times as far as is usual around them; most take part all the same");
  add("isolated", "vertices without a triangle");
  add("repeated_vertex_triangles", "triangles that name a vertex twice and are dropped");
  add("not_finite_triangles", "triangles with a vertex that is not finite, which are dropped");
  add("degenerate_faces", "faces without area");
  add("nonmanifold_edges", "edges of more than two triangles");
  const double points = info["points"].get<double>();
  if (info.contains("on_lines") && info["on_lines"].get<double>() > 0.05 * points)
    odd.push_back("points whose neighbours lie on one line, as on the rings of a spinning scanner: " +
                  std::to_string(info["on_lines"].get<std::int64_t>()));
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

void print(const Json& info) {
  const auto integer = [&info](const char* member) { return static_cast<long long>(info[member].get<std::int64_t>()); };
  const auto real = [&info](const char* member) { return info[member].get<double>(); };
  const bool is_mesh = info["kind"] == "mesh";
  std::printf("%-15s %s (%s)\n", "file", info["file"].get<std::string>().c_str(), is_mesh ? "mesh" : "cloud");
  std::printf("%-15s %s\n", "format", info["format"].get<std::string>().c_str());
  std::printf("%-15s %lld", "points", integer("points"));
  if (info["organized"]) std::printf(", organized %lld x %lld", integer("width"), integer("height"));
  if (is_mesh) std::printf("; %lld triangles, %lld polygons triangulated", integer("triangles"), integer("polygons"));
  std::printf("\n");
  printFields(info);
  if (info["merged_vertices"].get<std::int64_t>() > 0)
    std::printf("%-15s %lld equal corners\n", "merged", integer("merged_vertices"));
  if (info["viewpoint"] != Json(tufted::Geometry().viewpoint))
    std::printf("%-15s %s\n", "viewpoint", info["viewpoint"].dump().c_str());
  printTriple("lowest", info["lowest"]);
  printTriple("highest", info["highest"]);
  std::printf("%-15s %.4g (%.4g to %.4g)\n", "spacing", real("spacing"), real("spacing_low"), real("spacing_high"));
  std::printf("%-15s %.4g\n", "float step", real("float_step"));
  if (is_mesh) {
    std::printf("%-15s %.4g\n", "mean edge", real("mean_edge"));
    std::printf("%-15s %lld boundary, %lld nonmanifold\n", "edges", integer("boundary_edges"),
                integer("nonmanifold_edges"));
  }
  if (info.value("neighbors_clamped", false))
    std::printf("%-15s %lld, all other points\n", "neighbors", integer("neighbors"));
  std::printf("%-15s %lld\n", is_mesh ? "components" : "graph parts", integer(is_mesh ? "components" : "graph_parts"));
  if (info.value("structure", "") == nameOf(Structure::image))
    std::printf("%-15s %s\n", "structure", "depth image, built by its pixels");
  for (const Json& sentence : info["odd"]) std::printf("%-15s %s\n", "odd", sentence.get<std::string>().c_str());
  std::printf("%-15s %.2g s, %.0f MB\n", "to expect", real("expected_seconds"), real("expected_bytes") / 1e6);
}

/// Explains why no point would be active; otherwise an empty string. Builds a cloud only if that is possible.
std::string findNothing(const Settings& settings, const tufted::Geometry& geometry,
                        const tufted::CloudDescription& cloud) {
  const std::int64_t usable = cloud.points - cloud.not_finite - cloud.coincident;
  if (usable >= 3 && cloud.on_lines < usable) return "";
  tufted::CloudOptions options = settings.cloud;
  options.keep_cover = false;
  return nothingActive(tufted::pointCloudLaplacian(geometry.points, options));
}

int runInfo(Settings settings) {
  ProgressBar bar(settings.console.quiet);
  settings.cloud.progress = [&bar](std::string_view stage, double fraction) {
    bar.show(stage, fraction);
    return !interrupted();
  };
  settings.cloud.progress("read", 0);
  const tufted::Geometry geometry = readInput(settings.input, settings.cloud.progress);
  if (interrupted()) throw tufted::Cancelled("cancelled");
  Json info = describeFile(settings, geometry);
  const tufted::CloudDescription points = tufted::describeCloud(geometry.points, settings.cloud);
  addExtent(points, info);
  std::string nothing;
  if (geometry.is_mesh) {
    const tufted::MeshOptions options = {.threads = settings.cloud.threads,
                                         .keep_cover = false,
                                         .weld = settings.input.weld,
                                         .progress = settings.cloud.progress};
    const tufted::Laplacian laplacian = tufted::meshLaplacian(geometry.points, geometry.triangles, options);
    addMesh(laplacian.report, info);
    nothing = nothingActive(laplacian);
  } else {
    // As in a build, --neighbors asks for a search.
    const Structure structure = settings.neighbors->count() == 0 ? structureFor(geometry) : Structure::none;
    addCloud(points, settings.cloud.neighbors, structure, info);
    nothing = findNothing(settings, geometry, points);
  }
  info["odd"] = findOddities(info, settings.input.weld);
  bar.clear();
  std::vector<std::string> warnings = geometry.notes;
  if (!nothing.empty()) warnings.push_back(settings.input.name() + ": " + nothing);
  for (const std::string& warning : warnings) warn(bar, warning);
  info["warnings"] = warnings;
  if (settings.console.json)
    std::printf("%s\n", info.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
  else if (!settings.console.quiet)
    print(info);
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
  settings->neighbors = addNumber(command, "--neighbors", settings->cloud.neighbors, 3, std::numeric_limits<int>::max(),
                                  "Number of neighbours per point, clouds only (30)")
                            ->type_name("K");
  addNumber(command, "--threads", settings->cloud.threads, 1, 1 << 16, "Maximum number of threads (one per processor)")
      ->type_name("N");
  addConsole(command, settings->console);
  command.callback([&run, settings] { run = [=] { return runInfo(*settings); }; });
}
