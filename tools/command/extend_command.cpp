#include "subcommand.h"
#include "tufted/vector_heat.h"

namespace {

struct Extend : Subcommand {
  explicit Extend(CLI::App& app)
      : Subcommand(app, "extend", "Give every point approximately the value of the nearest pin.", R"(Example:
  tufted extend scan.ply --pin 0=20 --pin 17=25 --out values

A pin is a point with a given value. --pin takes INDEX=V or X,Y,Z=V (the point nearest to a position), with V1,V2,...
for several values at once; --pins and --pins-near take text files.
Every other point receives the mean of the values of all pins, weighted by the heat that reaches it from each: the value
of the nearest pin, except in a transition a few spacings wide. `tufted interpolate` blends over the whole surface.

Files in DIR, which replace older ones when all are complete:
  values.npy   N values or N x c, float64; NaN where no path leads
  points.ply   the points with the field values, float32; points.pcd with --format pcd
  report.json  pins, time step, rounds, residual, backward error, seconds)") {
    addPinOptions(command, pins);
    addTimeStep(command, time_step, "Time step in mean squared edges; larger values widen the transitions (4)");
  }

  void check(const Operator& source) override {
    checkPositions(source);
    placed = placePins(pins, source);
    shown = {{"values", placed.values.cols()}};
  }

  Results compute(Operator& source) override {
    Results results;
    const tufted::Pins located = placed.locate(source, results);
    options.solver = source.solverOptions();
    if (time_step) options.time_step = *time_step;
    const tufted::ExtensionSolver solver(source.laplacian, options);
    checkTimeStep(time_step, solver.timeStep(), source);
    tufted::VectorHeatReport made;
    Eigen::MatrixXd values = solver.query(located.points, located.values, &made, source.progress);
    results.report["pins"] = located.points.size();
    results.report["time_step"] = solver.timeStep();
    results.summary.add("pins", "%zu", located.points.size());
    results.summary.add("not reached", "%lld points, which are NaN",
                        static_cast<long long>(values.col(0).array().isNaN().count()));
    addReport(made, solver.report(), results);
    results.arrays = {{.name = "values", .values = std::move(values)}};
    return results;
  }

  PinOptions pins;
  PlacedPins placed;
  tufted::VectorHeatOptions options;
  std::optional<double> time_step;

  std::vector<std::string> files() const override { return {"values.npy"}; }
};

}  // namespace

void addExtend(CLI::App& app, Run& run) {
  addSubcommand<Extend>(app, run);
}
