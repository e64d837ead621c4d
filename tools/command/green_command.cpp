#include <CLI/CLI.hpp>

#include "command.h"
#include "operator.h"
#include "point_options.h"
#include "reports.h"
#include "taking_part.h"
#include "tufted/errors.h"
#include "tufted/interpolation.h"

namespace green_command {
namespace {

constexpr const char* description = "Compute Green's functions of points: L g = delta - M / area, with mean 0.";

constexpr const char* footer = R"(Example:
  tufted green scan.ply --source 0 --out green

Files in DIR, which replace older ones when all are complete:
  green.npy    N values, or N x c for c points, float64; 0 on other components, NaN at points that take no part
  points.ply   the points with the field green, float32; points.pcd with --format pcd
  report.json  method, iterations, residual, backward error, seconds, and parts that are almost disconnected, if any
`tufted help laplacian` explains FILE and the options of building. --operator DIR reads L and M that
`tufted laplacian --out DIR` wrote.)";

struct Settings {
  OperatorSettings source;
  NamedPoints points;
  std::vector<Place> places;

  std::vector<std::string> files() const { return {"green.npy"}; }
};

void check(Settings& settings, const Operator& source) {
  settings.places = settings.points.places(source);
  if (settings.places.empty())
    throw tufted::InvalidInput("no point is given, must be at least one by --source, --near or --sources");
  settings.source.shown = {{"green", std::ssize(settings.places)}};
}

Results compute(Settings& settings, Operator& source) {
  Results results;
  const std::vector<int> points = locate(settings.places, source, results);
  requireTakingPart(points, source);
  tufted::SolveReport made;
  results.arrays = {
      {.name = "green", .values = tufted::greensFunction(source.laplacian, points, source.solverOptions(), &made)}};
  results.report["sources"] = points;
  results.summary.add("points", "%zu", points.size());
  addReport(made, results);
  return results;
}

}  // namespace
}  // namespace green_command

void addGreen(CLI::App& app, Run& run) {
  using namespace green_command;
  const auto [command, settings] = addOperatorCommand<Settings>(app, run, "green", description, footer, compute, check);
  addPointOptions(*command, settings->points, "Points of the Green's functions, a column for each");
}
