#include "subcommand.h"
#include "tufted/interpolation.h"

namespace {

struct Green : Subcommand {
  explicit Green(CLI::App& app)
      : Subcommand(app, "green", "Compute Green's functions of points: L g = delta - M / area, with mean 0.",
                   R"(Example:
  tufted green scan.ply --source 0 --out green

Files in DIR, which replace older ones when all are complete:
  green.npy    N values, or N x c for c points, float64; 0 on other components, NaN at points that take no part
  points.ply   the points with the field green, float32; points.pcd with --format pcd
  report.json  method, iterations, residual, backward error, seconds, and parts that are almost disconnected, if any)") {
    addPointOptions(command, points, "Points of the Green's functions, a column for each");
  }

  void check(const Operator& source) override {
    places = points.places(source);
    if (places.empty())
      throw tufted::InvalidInput("no point is given, must be at least one by --source, --near or --sources");
    shown = {{"green", std::ssize(places)}};
  }

  Results compute(Operator& source) override {
    Results results;
    const std::vector<int> sources = locate(places, source, results);
    requireTakingPart(sources, source);
    tufted::SolveReport made;
    results.arrays = {
        {.name = "green", .values = tufted::greensFunction(source.laplacian, sources, source.solverOptions(), &made)}};
    results.report["sources"] = sources;
    results.summary.add("points", "%zu", sources.size());
    addReport(made, results);
    return results;
  }

  NamedPoints points;
  std::vector<Place> places;

  std::vector<std::string> files() const override { return {"green.npy"}; }
};

}  // namespace

void addGreen(CLI::App& app, Run& run) {
  addSubcommand<Green>(app, run);
}
