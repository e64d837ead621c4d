#include <CLI/CLI.hpp>

#include "command.h"
#include "operator.h"
#include "options.h"
#include "pin_options.h"
#include "reports.h"
#include "signal_options.h"
#include "tufted/errors.h"
#include "tufted/interpolation.h"

namespace poisson_command {
namespace {

constexpr const char* description = "Solve Poisson's equation L u = M f: minus the Laplacian of u is f.";

constexpr const char* footer =
    R"(Example:
  tufted poisson scan.ply --field x --out solution

On each component the equation has a solution only if f has mean 0. Without pins the mean of f, weighted by M, is
therefore subtracted, and u has mean 0. With pins, given as for `tufted interpolate`, u has the values of the pins, the
equation holds at all other points, nothing is subtracted, and components without a pin are NaN.

Files in DIR, which replace older ones when all are complete:
  u.npy        N values, or N x c for c columns of f, float64; NaN at points that take no part
  mean.npy     without pins: the mean that was subtracted from f at each point, in the same shape as u
  points.ply   the points with the fields u and mean, float32; points.pcd with --format pcd
  report.json  the largest mean subtracted, method, iterations, residual, backward error, seconds, and parts that are
               almost disconnected, if any
`tufted help laplacian` explains FILE and the options of building. --operator DIR reads L and M that
`tufted laplacian --out DIR` wrote.)";

struct Settings {
  OperatorSettings source;
  SignalOptions signals;
  PinOptions pins;
  Eigen::MatrixXd f;
  PlacedPins placed;

  std::vector<std::string> files() const {
    return pins.empty() ? std::vector<std::string>{"u.npy", "mean.npy"} : std::vector<std::string>{"u.npy"};
  }
};

void check(Settings& settings, const Operator& source) {
  settings.f = readSignals(settings.signals, source);
  settings.source.shown = {{"u", settings.f.cols()}};
  if (settings.pins.empty()) settings.source.shown.push_back({"mean", settings.f.cols()});
  if (settings.pins.empty()) return;
  settings.placed = placePins(settings.pins, source);
  if (settings.placed.values.cols() != settings.f.cols())
    throw tufted::InvalidInput("pins have " + std::to_string(settings.placed.values.cols()) +
                               " values, must have as many as f has columns, " + std::to_string(settings.f.cols()));
}

Results compute(Settings& settings, Operator& source) {
  requireFinite(settings.f, source);
  tufted::SolveReport made;
  Results results;
  if (settings.pins.empty()) {
    Eigen::MatrixXd mean = tufted::componentMeans(source.laplacian, settings.f);
    const double greatest = mean.size() > 0 ? mean.cwiseAbs().maxCoeff() : 0;
    results.report["greatest_mean"] = greatest;
    results.summary.add("mean removed", "%.6g at most, of %s", greatest,
                        countText(source.laplacian.report.components, "component").c_str());
    results.arrays = {
        {.name = "u", .values = tufted::poisson(source.laplacian, settings.f, source.solverOptions(), &made)},
        {.name = "mean", .values = std::move(mean)}};
  } else {
    const tufted::Pins pins = settings.placed.locate(source, results);
    results.report["pins"] = pins.points.size();
    results.summary.add("pins", "%zu", pins.points.size());
    results.arrays = {
        {.name = "u", .values = tufted::poisson(source.laplacian, settings.f, pins, source.solverOptions(), &made)}};
  }
  addReport(made, results);
  return results;
}

}  // namespace
}  // namespace poisson_command

void addPoisson(CLI::App& app, Run& run) {
  using namespace poisson_command;
  const auto [command, settings] =
      addOperatorCommand<Settings>(app, run, "poisson", description, footer, compute, check);
  addSignalOptions(*command, settings->signals, "Right-hand side f");
  addPinOptions(*command, settings->pins);
}
