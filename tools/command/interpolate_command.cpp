#include "subcommand.h"
#include "tufted/interpolation.h"

namespace {

struct Interpolate : Subcommand {
  explicit Interpolate(CLI::App& app)
      : Subcommand(app, "interpolate",
                   "Interpolate values that are given at some points, blending over the whole surface.", R"(Example:
  tufted interpolate scan.ply --pin 0=20 --pin 17=25 --out values

A pin is a point with a given value. --pin takes INDEX=V or X,Y,Z=V (the point nearest to a position), with V1,V2,...
for several values at once; --pins and --pins-near take text files. Several pins at one point count as their mean.
  harmonic    L u = 0 except at the pins: stays within the values of the pins and has peaks at them
  biharmonic  bends least: smooth at the pins, but may exceed their values
Points that no path joins to a pin are NaN.

Files in DIR, which replace older ones when all are complete:
  values.npy   N values or N x c, float64
  points.ply   the points with the field values, float32; points.pcd with --format pcd
  report.json  method, iterations, residual, backward error, seconds, and parts that are almost disconnected, if any)") {
    addPinOptions(command, pins);
    addChoice(command, "--method", method, methods,
              "harmonic: stays within the values of the pins; biharmonic: smooth at the pins (harmonic)");
  }

  enum class Method { harmonic, biharmonic };
  static inline const std::map<std::string, Method> methods = {{"harmonic", Method::harmonic},
                                                               {"biharmonic", Method::biharmonic}};

  void check(const Operator& source) override {
    placed = placePins(pins, source);
    shown = {{"values", placed.values.cols()}};
  }

  Results compute(Operator& source) override {
    Results results;
    const tufted::Pins located = placed.locate(source, results);
    const bool is_harmonic = method == Method::harmonic;
    tufted::SolveReport made;
    Eigen::MatrixXd values = is_harmonic ? tufted::harmonic(source.laplacian, located, source.solverOptions(), &made)
                                         : tufted::biharmonic(source.laplacian, located, source.solverOptions(), &made);
    const long long unreached = values.col(0).array().isNaN().count();
    results.arrays = {{.name = "values", .values = std::move(values)}};
    results.report["method"] = is_harmonic ? "harmonic" : "biharmonic";
    results.report["pins"] = located.points.size();
    results.summary.add("pins", "%zu", located.points.size());
    results.summary.add("not reached", "%lld points, which are NaN", unreached);
    addReport(made, results);
    return results;
  }

  PinOptions pins;
  PlacedPins placed;
  Method method = Method::harmonic;

  std::vector<std::string> files() const override { return {"values.npy"}; }
};

}  // namespace

void addInterpolate(CLI::App& app, Run& run) {
  addSubcommand<Interpolate>(app, run);
}
