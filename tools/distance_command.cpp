#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "command.h"
#include "operator.h"
#include "options.h"
#include "point_options.h"
#include "progress_bar.h"
#include "tufted/distance.h"
#include "tufted/errors.h"

namespace {

constexpr const char* description = "Geodesic distance from the nearest of some points, by the heat method.";

constexpr const char* footer =
    R"(Distances are in the file's unit: 0 at sources, infinite where no path leads (other components,
isolated points). On meshes --face names a point inside a triangle by its barycentric coordinates.

Writes into DIR, renamed one after the other when all are complete:
  distance.npy  N distances, float64
  points.ply    the points with the field distance, float32; points.pcd with --format pcd
  report.json   sources, rounds, residual, seconds
FILE and the options of building are those of `tufted laplacian`. A Laplacian from a folder will not do, as the
method needs its triangles.)";

const std::map<std::string, tufted::TimeUnit> units = {{"mean", tufted::TimeUnit::mean_edge},
                                                       {"adapted", tufted::TimeUnit::adapted_edge}};

struct Settings {
  OperatorSettings source;
  NamedPoints points;
  std::vector<std::string> faces;
  tufted::DistanceOptions options;
};

std::vector<tufted::SurfacePoint> sourcesOf(const Settings& settings, const Operator& source) {
  std::vector<tufted::SurfacePoint> sources;
  for (const int i : indicesOf(settings.points, source)) sources.push_back(tufted::SurfacePoint::vertex(i));
  if (!settings.faces.empty() && !source.geometry.is_mesh)
    throw tufted::InvalidInput("--face applies to meshes, and " + settings.source.name() + " is a cloud");
  for (const std::string& text : settings.faces) {
    const std::vector<double> numbers = parseNumbers(text, "--face");
    const bool valid = numbers.size() == 4 && numbers[0] == std::floor(numbers[0]) && std::abs(numbers[0]) < 2e9;
    if (!valid) throw tufted::InvalidInput("--face " + text + " is not FACE,A,B,C");
    sources.push_back(tufted::SurfacePoint::inFace(source.geometry.points, source.geometry.triangles,
                                                   static_cast<int>(numbers[0]), {numbers[1], numbers[2], numbers[3]}));
  }
  return sources;
}

int runDistance(Settings& settings) {
  ProgressBar bar;
  const tufted::Progress progress = showOn(bar);
  const Operator source =
      loadOperator(settings.source, {"distance.npy", "points.ply", "points.pcd", "report.json"}, true, progress);
  const std::vector<tufted::SurfacePoint> sources = sourcesOf(settings, source);
  settings.options.solver.threads = settings.source.threads();
  settings.options.solver.progress = progress;
  const tufted::DistanceSolver solver(source.laplacian, settings.options);
  tufted::DistanceReport made;
  const tufted::VectorXd distance = solver.queryAt(sources, &made);
  nlohmann::ordered_json corners = nlohmann::ordered_json::array();
  for (const tufted::SurfacePoint& point : sources)
    corners.push_back({{"corners", point.corners}, {"weights", point.weights}});
  const nlohmann::ordered_json report = {{"sources", corners},
                                         {"time_step", solver.timeStep()},
                                         {"report",
                                          {{"rounds", made.rounds},
                                           {"iterations", made.iterations},
                                           {"residual", made.residual},
                                           {"seconds", made.seconds}}}};
  writeOperatorResults(settings.source, "distance", source, {{.name = "distance", .values = distance}}, report.dump(),
                       progress);
  bar.clear();
  long long reached = 0;
  double farthest = 0;
  for (const double d : distance) {
    if (!std::isfinite(d)) continue;
    ++reached;
    farthest = std::max(farthest, d);
  }
  std::printf("%-15s %lld of %lld, the farthest at %.6g\n", "reached", reached, static_cast<long long>(distance.size()),
              farthest);
  std::printf("%-15s %d rounds of heat, residual %.1e, %.3g s\n", "query", made.rounds, made.residual, made.seconds);
  std::printf("%-15s %s\n", "written to", settings.source.out.c_str());
  if (std::fflush(stdout) != 0) throw tufted::IoError("standard output: cannot write the summary");
  return exit_done;
}

}  // namespace

void addDistance(CLI::App& app, Run& run) {
  CLI::App& command = *app.add_subcommand("distance", description);
  command.footer(footer);
  const auto settings = std::make_shared<Settings>();
  addOperatorOptions(command, settings->source, false);
  addPointOptions(command, settings->points, "Points of distance 0");
  command.add_option("--face", settings->faces, "A point of distance 0 inside a triangle, meshes only")
      ->allow_extra_args(false)
      ->type_name("FACE,A,B,C");
  addNumber(command, "--time-step", settings->options.time_step, std::numeric_limits<double>::min(), 1e12,
            "Time step in --time-unit; larger ones smooth (0.5)")
      ->type_name("T");
  addChoice(command, "--time-unit", settings->options.unit, units,
            "Squared mean edge; adapted: weighted by area, for uneven density (mean)");
  command.callback([&run, settings] { run = [=] { return runDistance(*settings); }; });
}
