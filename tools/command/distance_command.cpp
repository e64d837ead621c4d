#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "command.h"
#include "operator.h"
#include "options.h"
#include "point_options.h"
#include "reports.h"
#include "time_step.h"
#include "tufted/distance.h"
#include "tufted/errors.h"

namespace {

constexpr const char* description = "Geodesic distance from the nearest of some points, by the heat method.";

constexpr const char* footer =
    R"(Example:
  tufted distance scan.ply --source 0 --out distance

Distances are in the file's unit: 0 at sources, infinite where no path leads (other components,
isolated points). --near takes the point nearest to a position, says which, and warns where that is farther from it
than from its neighbours. On meshes --face names a point inside a triangle by its barycentric coordinates.

Writes into DIR, renamed one after the other when all are complete:
  distance.npy  N distances, float64
  points.ply    the points with the field distance, float32; points.pcd with --format pcd
  report.json   sources, method, rounds, residual, backward error, seconds
FILE and the options of building are those of `tufted laplacian`; --operator takes what that has written with
--format npz,ply,cover: the method needs the cover's triangles.)";

const std::map<std::string, tufted::TimeUnit> units = {{"mean", tufted::TimeUnit::mean_edge},
                                                       {"adapted", tufted::TimeUnit::adapted_edge}};

struct Settings {
  OperatorSettings source;
  NamedPoints points;
  std::vector<std::string> faces;
  tufted::DistanceOptions options;
  std::optional<double> time_step;
  std::vector<Place> places;
  std::vector<tufted::SurfacePoint> inside;  ///< of faces

  std::vector<std::string> files() const { return {"distance.npy"}; }
};

void check(Settings& settings, const Operator& source) {
  settings.places = settings.points.places(source.points());
  if (!settings.faces.empty() && !source.geometry.is_mesh)
    throw tufted::InvalidInput("--face applies to meshes, and " + source.name +
                               (source.geometry.points.rows() > 0 ? " is a cloud" : " has no points"));
  for (const std::string& text : settings.faces) {
    const std::vector<double> numbers = parseNumbers(text, "--face");
    const bool valid = numbers.size() == 4 && numbers[0] == std::floor(numbers[0]) && std::abs(numbers[0]) < 2e9;
    if (!valid) throw tufted::InvalidInput("--face " + text + " is not FACE,A,B,C");
    settings.inside.push_back(forOption("--face " + text, [&] {
      return tufted::SurfacePoint::inFace(source.geometry.points, source.geometry.triangles,
                                          static_cast<int>(numbers[0]), {numbers[1], numbers[2], numbers[3]});
    }));
  }
  if (settings.places.empty() && settings.inside.empty())
    throw tufted::InvalidInput("no source is given, must be at least one by --source, --near, --sources or --face");
}

Results compute(Settings& settings, Operator& source) {
  Results results;
  std::vector<tufted::SurfacePoint> sources;
  for (const int point : locate(settings.places, source, results))
    sources.push_back(tufted::SurfacePoint::vertex(point));
  sources.insert(sources.end(), settings.inside.begin(), settings.inside.end());
  settings.options.solver = source.solverOptions();
  if (settings.time_step) settings.options.time_step = *settings.time_step;
  const tufted::DistanceSolver solver(source.laplacian, settings.options);
  checkTimeStep(settings.time_step, solver.timeStep(), source);
  tufted::DistanceReport made;
  const tufted::VectorXd distance = solver.queryAt(sources, &made, source.progress);
  results.arrays = {{.name = "distance", .values = distance}};
  results.report["sources"] = nlohmann::ordered_json::array();
  for (const tufted::SurfacePoint& point : sources)
    results.report["sources"].push_back({{"corners", point.corners}, {"weights", point.weights}});
  results.report["time_step"] = solver.timeStep();
  addReport(made, solver.report(), results);
  long long reached = 0;
  double farthest = 0;
  for (const double d : distance) {
    if (!std::isfinite(d)) continue;
    ++reached;
    farthest = std::max(farthest, d);
  }
  results.summary.add("reached", "%lld of %lld, the farthest at %.6g", reached, static_cast<long long>(distance.size()),
                      farthest);
  return results;
}

}  // namespace

void addDistance(CLI::App& app, Run& run) {
  const auto [command, settings] =
      addOperatorCommand<Settings>(app, run, "distance", description, footer, compute, check);
  settings->source.needs_cover = true;
  addPointOptions(*command, settings->points, "Points of distance 0");
  command->add_option("--face", settings->faces, "A point of distance 0 inside a triangle, meshes only")
      ->allow_extra_args(false)
      ->type_name("FACE,A,B,C");
  addTimeStep(*command, settings->time_step, "Time step in --time-unit; larger ones smooth (0.5)");
  addChoice(*command, "--time-unit", settings->options.unit, units,
            "Squared mean edge; adapted: weighted by area, for uneven density (mean)");
}
