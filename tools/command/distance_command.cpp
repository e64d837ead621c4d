#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>

#include "command.h"
#include "extent.h"
#include "operator.h"
#include "options.h"
#include "point_options.h"
#include "reports.h"
#include "taking_part.h"
#include "time_step.h"
#include "tufted/distance.h"
#include "tufted/errors.h"

namespace distance_command {
namespace {

constexpr const char* description = "Compute the geodesic distance of every point from the nearest source.";

constexpr const char* footer =
    R"(Examples:
  tufted distance scan.ply --source 0 --out distance
  tufted distance scan.ply --near 1,2,0.5 --within 0.3 --out around
  tufted distance scan.ply --source 0,17,99 --labels --out cells
  tufted distance scan.ply --source 0,17,99 --matrix --out landmarks

Distances are in the unit of FILE. They are 0 at sources, and infinite beyond --within and where no path leads: in other
components and at isolated points. The summary names the point that --near found. If that point is farther from the
position than from its own neighbours, a warning says so.

  marching  the front passes from triangle to triangle, with the source unfolded into the plane of each. This method is
            more accurate and needs no factorisation. On meshes each --split lowers the error to 0.6 of its value and
            takes three to four times as long. With --within, up to 64 sources, and without --labels, --matrix and
            --face, only the surface around the sources is prepared.
  heat      the distance is smooth where fronts meet. --time-step, --time-unit, --solver and --memory-limit apply to
            this method only.

Files in DIR, which replace older ones when all are complete:
  distance.npy  N distances, float64; with --matrix N x K, a column for each source. Between two sources, distances
                found from either end differ by up to 6 % of the largest; --symmetric writes their mean
  labels.npy    with --labels: N numbers of the nearest source, int32, from 0 in the order --source, --near, --sources,
                --face; -1 where no path leads
  points.ply    the points with the field distance, float32; points.pcd with --format pcd
  report.json   sources, method, counts of the query, seconds
`tufted help laplacian` explains FILE and the options of building. --operator DIR reads L and M that
`tufted laplacian --format npz,ply,cover --out DIR` wrote: distances
need the triangles of the cover.)";

/// Up to this many sources, distances within a radius are computed around each, without a solver for the whole surface.
constexpr std::size_t few_sources = 64;

const std::map<std::string, tufted::TimeUnit> units = {{"mean", tufted::TimeUnit::mean_edge},
                                                       {"adapted", tufted::TimeUnit::adapted_edge}};

const std::map<std::string, tufted::DistanceMethod> methods = {{"marching", tufted::DistanceMethod::marching},
                                                               {"heat", tufted::DistanceMethod::heat}};

struct Settings {
  OperatorSettings source;
  NamedPoints points;
  std::vector<std::string> faces;
  tufted::DistanceOptions options;
  std::optional<double> time_step;
  std::optional<tufted::TimeUnit> time_unit;
  bool labels = false, matrix = false, symmetric = false;
  std::vector<Place> places;
  std::vector<tufted::SurfacePoint> inside;  ///< sources inside faces

  std::vector<std::string> files() const {
    std::vector<std::string> names = {"distance.npy"};
    if (labels) names.emplace_back("labels.npy");
    return names;
  }
};

/// @throws InvalidInput for options of the other method
void checkMethod(const Settings& settings) {
  if (settings.symmetric && !settings.faces.empty())
    throw tufted::InvalidInput("--symmetric needs sources at points, so it excludes --face");
  const bool is_heat = settings.options.method == tufted::DistanceMethod::heat;
  if (!is_heat && settings.time_step) throw tufted::InvalidInput("--time-step applies to --method heat");
  if (!is_heat && settings.time_unit) throw tufted::InvalidInput("--time-unit applies to --method heat");
  if (is_heat && settings.options.split) throw tufted::InvalidInput("--split applies to --method marching");
}

void check(Settings& settings, const Operator& source) {
  checkMethod(settings);
  settings.places = settings.points.places(source);
  settings.inside = pointsInFaces(settings.faces, source);
  if (settings.places.empty() && settings.inside.empty())
    throw tufted::InvalidInput("no source is given, must be at least one by --source, --near, --sources or --face");
  settings.source.stages = {{"faces", 26, 2}, {"edges", 3}, {"march", 18}};
  if (settings.options.method == tufted::DistanceMethod::heat)
    settings.source.stages = {{"faces", 26},  {"analyse", 15}, {"factor", 33}, {"analyse", 15},
                              {"factor", 33}, {"analyse", 15}, {"factor", 33}, {"solve", 6, 3}};
  if (settings.matrix)
    settings.source.shown = {{"distance", std::ssize(settings.places) + std::ssize(settings.inside)}};
}

/// N distances from the nearest source. With --labels adds to the results which source that is.
Eigen::MatrixXd addNearest(const Settings& settings, const tufted::DistanceSolver& solver,
                           const std::vector<tufted::SurfacePoint>& sources, const Operator& source,
                           tufted::DistanceReport& made, Results& results) {
  if (!settings.labels) return solver.queryAt(sources, &made, source.progress);
  const tufted::NearestSources found = solver.nearest(sources, &made, source.progress);
  results.arrays.push_back({.name = "labels", .values = columnOf(found.source), .is_integer = true});
  return found.distance;
}

/// Whether pointsWithin() suffices, which visits only the surface around the sources.
bool isLocal(const Settings& settings) {
  return settings.options.method == tufted::DistanceMethod::marching && std::isfinite(settings.options.maximum) &&
         !settings.labels && !settings.matrix && settings.inside.empty() && settings.places.size() <= few_sources;
}

/// N distances by pointsWithin(), infinite beyond --within.
Eigen::MatrixXd addNearby(const Settings& settings, const std::vector<tufted::SurfacePoint>& sources,
                          const Operator& source, Results& results) {
  std::vector<int> points;
  points.reserve(sources.size());
  for (const tufted::SurfacePoint& point : sources) points.push_back(point.corners[0]);
  const auto start = std::chrono::steady_clock::now();
  const tufted::NearbyPoints near =
      tufted::pointsWithin(source.laplacian, points, settings.options.maximum, settings.options.split, source.progress);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  Eigen::MatrixXd distance = Eigen::MatrixXd::Constant(source.points(), 1, std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < near.points.size(); ++i) distance(near.points[i], 0) = near.distances[i];
  results.report["report"] = {{"seconds", seconds}};
  results.summary.addDetail("query", "the surface around the sources alone, %.3g s", seconds);
  return distance;
}

/// N x 1 or N x K distances by a solver for the whole surface.
Eigen::MatrixXd addSolved(const Settings& settings, const std::vector<tufted::SurfacePoint>& sources,
                          const Operator& source, Results& results) {
  const tufted::DistanceSolver solver(source.laplacian, settings.options);
  checkTimeStep(settings.time_step, solver.timeStep(), source);
  tufted::DistanceReport made;
  Eigen::MatrixXd distance = settings.matrix ? solver.matrix(sources, settings.symmetric, &made, source.progress)
                                             : addNearest(settings, solver, sources, source, made, results);
  if (solver.timeStep() > 0) results.report["time_step"] = solver.timeStep();
  addReport(made, solver.report(), results);
  return distance;
}

/// @throws InvalidInput for a radius so small that no other point can be within it
void checkWithin(double within, const Operator& source) {
  constexpr double nearest = 0.01;  // least radius, in spacings
  const Extent extent = extentOf(source);
  if (within < nearest * extent.spacing)
    throw tufted::InvalidInput("--within " + numberText(within) +
                               " is less than a hundredth of the spacing: " + extent.text());
}

Results compute(Settings& settings, Operator& source) {
  checkWithin(settings.options.maximum, source);
  Results results;
  std::vector<tufted::SurfacePoint> sources;
  const std::vector<int> points = locate(settings.places, source, results);
  noteLeftOut(points, source, results, !settings.inside.empty());
  for (const int point : points) sources.push_back(tufted::SurfacePoint::vertex(point));
  sources.insert(sources.end(), settings.inside.begin(), settings.inside.end());
  settings.options.solver = source.solverOptions();
  if (settings.time_step) settings.options.time_step = *settings.time_step;
  if (settings.time_unit) settings.options.unit = *settings.time_unit;
  results.report["sources"] = nlohmann::ordered_json::array();
  for (const tufted::SurfacePoint& point : sources)
    results.report["sources"].push_back({{"corners", point.corners}, {"weights", point.weights}});
  results.report["method"] = settings.options.method == tufted::DistanceMethod::heat ? "heat" : "marching";
  const Eigen::MatrixXd distance =
      isLocal(settings) ? addNearby(settings, sources, source, results) : addSolved(settings, sources, source, results);
  results.arrays.insert(results.arrays.begin(), {.name = "distance", .values = distance});
  long long reached = 0;
  double farthest = 0;
  for (const double d : distance.rowwise().minCoeff()) {
    if (!std::isfinite(d)) continue;
    ++reached;
    farthest = std::max(farthest, d);
  }
  results.summary.add("reached", "%lld of %lld, the farthest at %.6g", reached, static_cast<long long>(distance.rows()),
                      farthest);
  return results;
}

}  // namespace
}  // namespace distance_command

void addDistance(CLI::App& app, Run& run) {
  using namespace distance_command;
  const auto [command, settings] =
      addOperatorCommand<Settings>(app, run, "distance", description, footer, compute, check);
  settings->source.cover = CoverUse::all;
  addPointOptions(*command, settings->points, "Sources");
  addFaceOption(*command, settings->faces, "Source");
  addChoice(*command, "--method", settings->options.method, methods,
            "marching: more accurate; heat: smooth where fronts meet (marching)");
  addNumber(*command, "--split", settings->options.split, 0, 2,
            "With --method marching: how often each triangle is divided into four (2 up to 5,000 points, else 1)")
      ->type_name("TIMES");
  addNumber(*command, "--within", settings->options.maximum, std::numeric_limits<double>::min(),
            std::numeric_limits<double>::max(),
            "Longest distance that is computed, in the unit of FILE; beyond it infinite (no limit)")
      ->type_name("R");
  CLI::Option* const labels = command->add_flag(
      "--labels", settings->labels, "Also write the number of the nearest source of each point, labels.npy");
  CLI::Option* const matrix =
      command
          ->add_flag("--matrix", settings->matrix,
                     "Write a column of distances for each source, instead of those from the nearest")
          ->excludes(labels);
  command
      ->add_flag("--symmetric", settings->symmetric,
                 "With --matrix: distances between sources are the mean of those found from either end")
      ->needs(matrix);
  addTimeStep(*command, settings->time_step,
              "With --method heat: time step in units of --time-unit; larger values smooth more (0.5)");
  addChoice(*command, "--time-unit", settings->time_unit, units,
            "With --method heat: mean squared edge; adapted: weighted by area, for very uneven density (mean)");
}
