#include "subcommand.h"
#include "tufted/interpolation.h"

namespace {

struct Poisson : Subcommand {
  explicit Poisson(CLI::App& app)
      : Subcommand(app, "poisson", "Solve Poisson's equation L u = M f: minus the Laplacian of u is f.", R"(Example:
  tufted poisson scan.ply --field x --out solution

On each component the equation has a solution only if f has mean 0. Without pins the mean of f, weighted by M, is
therefore subtracted, and u has mean 0. With pins, given as for `tufted interpolate`, u has the values of the pins, the
equation holds at all other points, nothing is subtracted, and components without a pin are NaN.

Files in DIR, which replace older ones when all are complete:
  u.npy        N values, or N x c for c columns of f, float64; NaN at points that take no part
  mean.npy     without pins: the mean that was subtracted from f at each point, in the same shape as u
  points.ply   the points with the fields u and mean, float32; points.pcd with --format pcd
  report.json  the largest mean subtracted, method, iterations, residual, backward error, seconds, and parts that are
               almost disconnected, if any)") {
    addSignalOptions(command, signals, "Right-hand side f");
    addPinOptions(command, pins);
  }

  void check(const Operator& source) override {
    f = readSignals(signals, source);
    shown = {{"u", f.cols()}};
    if (pins.empty()) shown.push_back({"mean", f.cols()});
    if (pins.empty()) return;
    placed = placePins(pins, source);
    if (placed.values.cols() != f.cols())
      throw tufted::InvalidInput("pins have " + std::to_string(placed.values.cols()) +
                                 " values, must have as many as f has columns, " + std::to_string(f.cols()));
  }

  Results compute(Operator& source) override {
    requireFinite(f, source);
    tufted::SolveReport made;
    Results results;
    if (pins.empty()) {
      Eigen::MatrixXd mean = tufted::componentMeans(source.laplacian, f);
      const double greatest = mean.size() > 0 ? mean.cwiseAbs().maxCoeff() : 0;
      results.report["greatest_mean"] = greatest;
      results.summary.add("mean removed", "%.6g at most, of %s", greatest,
                          countText(source.laplacian.report.components, "component").c_str());
      results.arrays = {{.name = "u", .values = tufted::poisson(source.laplacian, f, source.solverOptions(), &made)},
                        {.name = "mean", .values = std::move(mean)}};
    } else {
      const tufted::Pins located = placed.locate(source, results);
      results.report["pins"] = located.points.size();
      results.summary.add("pins", "%zu", located.points.size());
      results.arrays = {
          {.name = "u", .values = tufted::poisson(source.laplacian, f, located, source.solverOptions(), &made)}};
    }
    addReport(made, results);
    return results;
  }

  SignalOptions signals;
  PinOptions pins;
  Eigen::MatrixXd f;
  PlacedPins placed;

  std::vector<std::string> files() const override {
    return pins.empty() ? std::vector<std::string>{"u.npy", "mean.npy"} : std::vector<std::string>{"u.npy"};
  }
};

}  // namespace

void addPoisson(CLI::App& app, Run& run) {
  addSubcommand<Poisson>(app, run);
}
