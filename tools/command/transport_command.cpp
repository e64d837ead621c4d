#include "subcommand.h"
#include "tufted/vector_heat.h"

namespace {

struct Transport : Subcommand {
  explicit Transport(CLI::App& app)
      : Subcommand(app, "transport", "Carry tangent vectors from sources to all points by parallel transport.",
                   R"(Example:
  tufted transport scan.ply --source 0 --vector 1,0,0 --out vectors

--vector is repeated for each source, in the order --source, --near, --sources. Each vector is projected to the tangent
plane of its source. Every other point receives approximately the vector of the nearest source, turned with the surface
along the shortest path.

Files in DIR, which replace older ones when all are complete:
  vectors.npy  N x 3, float64, tangent to the surface; 0 where no path leads
  points.ply   the points with the fields vectors_0 to vectors_2, float32; points.pcd with --format pcd
  report.json  sources, time step, rounds, residual, backward error, seconds)") {
    addPointOptions(command, points, "Sources");
    command.add_option("--vector", texts, "Vector at a source; repeated for each source, see below")
        ->allow_extra_args(false)
        ->type_name("X,Y,Z");
    addTimeStep(command, time_step, "Time step in mean squared edges; larger values smooth more (4)");
  }

  void check(const Operator& source) override {
    checkFrames(source);
    places = points.places(source);
    if (places.empty())
      throw tufted::InvalidInput("no source is given, must be at least one by --source, --near or --sources");
    if (places.size() != texts.size())
      throw tufted::InvalidInput(std::to_string(texts.size()) + " of --vector for " + std::to_string(places.size()) +
                                 " sources, must be one for each");
    vectors.resize(std::ssize(texts), 3);
    for (std::size_t k = 0; k < texts.size(); ++k)
      vectors.row(static_cast<Eigen::Index>(k)) = parsePosition(texts[k], "--vector");
    if (vectors.isZero(0))
      throw tufted::InvalidInput("--vector " + texts[0] + " has no direction, and no other has one");
  }

  Results compute(Operator& source) override {
    Results results;
    const std::vector<int> sources = locate(places, source, results);
    noteLeftOut(sources, source, results);
    options.solver = source.solverOptions();
    if (time_step) options.time_step = *time_step;
    const tufted::TransportSolver solver(source.laplacian, framesOf(source), options);
    checkTimeStep(time_step, solver.timeStep(), source);
    tufted::VectorHeatReport made;
    const tufted::Points carried = solver.query(sources, vectors, &made, source.progress);
    results.report["sources"] = sources;
    results.report["time_step"] = solver.timeStep();
    addReport(made, solver.report(), results);
    const auto reached = (carried.rowwise().squaredNorm().array() > 0).count();
    results.summary.add("reached", "%lld of %lld", static_cast<long long>(reached),
                        static_cast<long long>(carried.rows()));
    results.arrays = {{.name = "vectors", .values = carried}};
    return results;
  }

  NamedPoints points;
  std::vector<std::string> texts;
  tufted::VectorHeatOptions options;
  std::optional<double> time_step;
  std::vector<Place> places;
  tufted::Points vectors;

  std::vector<std::string> files() const override { return {"vectors.npy"}; }
};

}  // namespace

void addTransport(CLI::App& app, Run& run) {
  addSubcommand<Transport>(app, run);
}
