#include <CLI/CLI.hpp>
#include <map>

#include "command.h"
#include "operator.h"
#include "options.h"
#include "pin_options.h"
#include "reports.h"
#include "tufted/interpolation.h"

namespace interpolate_command {
namespace {

constexpr const char* description =
    "Interpolate values that are given at some points, blending over the whole surface.";

constexpr const char* footer =
    R"(Example:
  tufted interpolate scan.ply --pin 0=20 --pin 17=25 --out values

A pin is a point with a given value. --pin takes INDEX=V or X,Y,Z=V (the point nearest to a position), with V1,V2,...
for several values at once; --pins and --pins-near take text files. Several pins at one point count as their mean.
  harmonic    L u = 0 except at the pins: stays within the values of the pins and has peaks at them
  biharmonic  bends least: smooth at the pins, but may exceed their values
Points that no path joins to a pin are NaN.

Files in DIR, which replace older ones when all are complete:
  values.npy   N values or N x c, float64
  points.ply   the points with the field values, float32; points.pcd with --format pcd
  report.json  method, iterations, residual, backward error, seconds, and parts that are almost disconnected, if any
`tufted help laplacian` explains FILE and the options of building. --operator DIR reads L and M that
`tufted laplacian --out DIR` wrote.)";

enum class Method { harmonic, biharmonic };
const std::map<std::string, Method> methods = {{"harmonic", Method::harmonic}, {"biharmonic", Method::biharmonic}};

struct Settings {
  OperatorSettings source;
  PinOptions pins;
  PlacedPins placed;
  Method method = Method::harmonic;

  std::vector<std::string> files() const { return {"values.npy"}; }
};

void check(Settings& settings, const Operator& source) {
  settings.placed = placePins(settings.pins, source);
  settings.source.shown = {{"values", settings.placed.values.cols()}};
}

Results compute(Settings& settings, Operator& source) {
  Results results;
  const tufted::Pins pins = settings.placed.locate(source, results);
  const bool harmonic = settings.method == Method::harmonic;
  tufted::SolveReport made;
  Eigen::MatrixXd values = harmonic ? tufted::harmonic(source.laplacian, pins, source.solverOptions(), &made)
                                    : tufted::biharmonic(source.laplacian, pins, source.solverOptions(), &made);
  const long long unreached = values.col(0).array().isNaN().count();
  results.arrays = {{.name = "values", .values = std::move(values)}};
  results.report["method"] = harmonic ? "harmonic" : "biharmonic";
  results.report["pins"] = pins.points.size();
  results.summary.add("pins", "%zu", pins.points.size());
  results.summary.add("not reached", "%lld points, which are NaN", unreached);
  addReport(made, results);
  return results;
}

}  // namespace
}  // namespace interpolate_command

void addInterpolate(CLI::App& app, Run& run) {
  using namespace interpolate_command;
  const auto [command, settings] =
      addOperatorCommand<Settings>(app, run, "interpolate", description, footer, compute, check);
  addPinOptions(*command, settings->pins);
  addChoice(*command, "--method", settings->method, methods,
            "harmonic: stays within the values of the pins; biharmonic: smooth at the pins (harmonic)");
}
