#include <CLI/CLI.hpp>
#include <optional>
#include <utility>

#include "command.h"
#include "operator.h"
#include "oriented.h"
#include "pin_options.h"
#include "reports.h"
#include "time_step.h"
#include "tufted/vector_heat.h"

namespace extend_command {
namespace {

constexpr const char* description = "Give every point approximately the value of the nearest pin.";

constexpr const char* footer =
    R"(Example:
  tufted extend scan.ply --pin 0=20 --pin 17=25 --out values

A pin is a point with a given value. --pin takes INDEX=V or X,Y,Z=V (the point nearest to a position), with V1,V2,...
for several values at once; --pins and --pins-near take text files.
Every other point receives the mean of the values of all pins, weighted by the heat that reaches it from each: the value
of the nearest pin, except in a transition a few spacings wide. `tufted interpolate` blends over the whole surface.

Files in DIR, which replace older ones when all are complete:
  values.npy   N values or N x c, float64; NaN where no path leads
  points.ply   the points with the field values, float32; points.pcd with --format pcd
  report.json  pins, time step, rounds, residual, backward error, seconds
`tufted help laplacian` explains FILE and the options of building. --operator DIR reads L and M that
`tufted laplacian --out DIR` wrote.)";

struct Settings {
  OperatorSettings source;
  PinOptions pins;
  PlacedPins placed;
  tufted::VectorHeatOptions options;
  std::optional<double> time_step;

  std::vector<std::string> files() const { return {"values.npy"}; }
};

void check(Settings& settings, const Operator& source) {
  checkPositions(source);
  settings.placed = placePins(settings.pins, source);
  settings.source.shown = {{"values", settings.placed.values.cols()}};
}

Results compute(Settings& settings, Operator& source) {
  Results results;
  const tufted::Pins pins = settings.placed.locate(source, results);
  settings.options.solver = source.solverOptions();
  if (settings.time_step) settings.options.time_step = *settings.time_step;
  const tufted::ExtensionSolver solver(source.laplacian, settings.options);
  checkTimeStep(settings.time_step, solver.timeStep(), source);
  tufted::VectorHeatReport made;
  Eigen::MatrixXd values = solver.query(pins.points, pins.values, &made, source.progress);
  results.report["pins"] = pins.points.size();
  results.report["time_step"] = solver.timeStep();
  results.summary.add("pins", "%zu", pins.points.size());
  results.summary.add("not reached", "%lld points, which are NaN",
                      static_cast<long long>(values.col(0).array().isNaN().count()));
  addReport(made, solver.report(), results);
  results.arrays = {{.name = "values", .values = std::move(values)}};
  return results;
}

}  // namespace
}  // namespace extend_command

void addExtend(CLI::App& app, Run& run) {
  using namespace extend_command;
  const auto [command, settings] =
      addOperatorCommand<Settings>(app, run, "extend", description, footer, compute, check);
  addPinOptions(*command, settings->pins);
  addTimeStep(*command, settings->time_step,
              "Time step in mean squared edges; larger values widen the transitions (4)");
}
