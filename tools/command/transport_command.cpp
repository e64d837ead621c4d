#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "operator.h"
#include "oriented.h"
#include "point_options.h"
#include "reports.h"
#include "taking_part.h"
#include "time_step.h"
#include "tufted/errors.h"
#include "tufted/vector_heat.h"

namespace transport_command {
namespace {

constexpr const char* description = "Carry tangent vectors from sources to all points by parallel transport.";

constexpr const char* footer =
    R"(Example:
  tufted transport scan.ply --source 0 --vector 1,0,0 --out vectors

--vector is repeated for each source, in the order --source, --near, --sources. Each vector is projected to the tangent
plane of its source. Every other point receives approximately the vector of the nearest source, turned with the surface
along the shortest path.

Files in DIR, which replace older ones when all are complete:
  vectors.npy  N x 3, float64, tangent to the surface; 0 where no path leads
  points.ply   the points with the fields vectors_0 to vectors_2, float32; points.pcd with --format pcd
  report.json  sources, time step, rounds, residual, backward error, seconds
`tufted help laplacian` explains FILE and the options of building. --operator DIR reads L and M that
`tufted laplacian --out DIR` wrote.)";

struct Settings {
  OperatorSettings source;
  NamedPoints points;
  std::vector<std::string> texts;
  tufted::VectorHeatOptions options;
  std::optional<double> time_step;
  std::vector<Place> places;
  tufted::Points vectors;

  std::vector<std::string> files() const { return {"vectors.npy"}; }
};

void check(Settings& settings, const Operator& source) {
  checkFrames(source);
  settings.places = settings.points.places(source);
  if (settings.places.empty())
    throw tufted::InvalidInput("no source is given, must be at least one by --source, --near or --sources");
  if (settings.places.size() != settings.texts.size())
    throw tufted::InvalidInput(std::to_string(settings.texts.size()) + " of --vector for " +
                               std::to_string(settings.places.size()) + " sources, must be one for each");
  settings.vectors.resize(std::ssize(settings.texts), 3);
  for (std::size_t k = 0; k < settings.texts.size(); ++k)
    settings.vectors.row(static_cast<Eigen::Index>(k)) = parsePosition(settings.texts[k], "--vector");
  if (settings.vectors.isZero(0))
    throw tufted::InvalidInput("--vector " + settings.texts[0] + " has no direction, and no other has one");
}

Results compute(Settings& settings, Operator& source) {
  Results results;
  const std::vector<int> sources = locate(settings.places, source, results);
  noteLeftOut(sources, source, results);
  settings.options.solver = source.solverOptions();
  if (settings.time_step) settings.options.time_step = *settings.time_step;
  const tufted::TransportSolver solver(source.laplacian, framesOf(source), settings.options);
  checkTimeStep(settings.time_step, solver.timeStep(), source);
  tufted::VectorHeatReport made;
  const tufted::Points vectors = solver.query(sources, settings.vectors, &made, source.progress);
  results.report["sources"] = sources;
  results.report["time_step"] = solver.timeStep();
  addReport(made, solver.report(), results);
  const auto reached = (vectors.rowwise().squaredNorm().array() > 0).count();
  results.summary.add("reached", "%lld of %lld", static_cast<long long>(reached),
                      static_cast<long long>(vectors.rows()));
  results.arrays = {{.name = "vectors", .values = vectors}};
  return results;
}

}  // namespace
}  // namespace transport_command

void addTransport(CLI::App& app, Run& run) {
  using namespace transport_command;
  const auto [command, settings] =
      addOperatorCommand<Settings>(app, run, "transport", description, footer, compute, check);
  addPointOptions(*command, settings->points, "Sources");
  command->add_option("--vector", settings->texts, "Vector at a source; repeated for each source, see below")
      ->allow_extra_args(false)
      ->type_name("X,Y,Z");
  addTimeStep(*command, settings->time_step, "Time step in mean squared edges; larger values smooth more (4)");
}
