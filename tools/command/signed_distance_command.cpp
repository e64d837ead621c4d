#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "moved_points.h"
#include "operator.h"
#include "options.h"
#include "oriented.h"
#include "point_options.h"
#include "reports.h"
#include "taking_part.h"
#include "time_step.h"
#include "tufted/errors.h"
#include "tufted/signed_distance.h"

namespace signed_distance_command {
namespace {

constexpr const char* description =
    "Compute the distance from a curve on the surface, positive on the left of the curve.";

constexpr const char* footer =
    R"(Example:
  tufted signed-distance mesh.off --curve curve.txt --out signed

--curve is a text file of the points along the curve in order, an INDEX per line; a closed curve ends with its first
point. The distance is positive on the left of the curve, seen from the side of the normals, which are those of
`tufted normals`. The curve may be open or have gaps, across which the distance continues smoothly. `tufted path` finds
paths between points.

Files in DIR, which replace older ones when all are complete:
  distance.npy  N distances, float64, in the unit of FILE; NaN on components without the curve, and at points that take
                no part
  points.ply    the points with the field distance, float32; points.pcd with --format pcd
  report.json   points and length of the curve, rounds, residual, seconds
`tufted help laplacian` explains FILE and the options of building. --operator DIR reads L and M that
`tufted laplacian --out DIR` wrote.)";

struct Settings {
  OperatorSettings source;
  Orienting orienting;
  std::filesystem::path file;
  tufted::VectorHeatOptions options;
  std::optional<double> time_step;
  std::vector<int> curve;

  std::vector<std::string> files() const { return {"distance.npy"}; }
};

void check(Settings& settings, const Operator& source) {
  settings.source.shown = {{"signed_distance"}};
  checkFrames(source);
  for (const Row& row : readRows(settings.file)) settings.curve.push_back(indexOf(row, source));
  if (settings.curve.size() < 2)
    throw tufted::IoError(settings.file.string() + ": has " + std::to_string(settings.curve.size()) +
                          " points, must have at least 2");
}

Results compute(Settings& settings, Operator& source) {
  Results results;
  noteLeftOut(settings.curve, source, results);
  settings.options.solver = source.solverOptions();
  if (settings.time_step) settings.options.time_step = *settings.time_step;
  const tufted::SignedDistanceSolver solver(source.laplacian, orientedFrames(settings.orienting, source, results),
                                            settings.options);
  checkTimeStep(settings.time_step, solver.timeStep(), source);
  tufted::SignedDistanceReport made;
  const Eigen::VectorXd distance =
      blameSurface(source, [&] { return solver.query(settings.curve, &made, source.progress); });
  results.report["curve"] = {{"points", made.curve_points}, {"length", made.curve_length}};
  results.summary.add("curve", "%lld points, length %.6g", static_cast<long long>(made.curve_points),
                      made.curve_length);
  addReport(made.heat, solver.report(), results);
  results.summary.add("not reached", "%lld points, which are NaN",
                      static_cast<long long>(distance.array().isNaN().count()));
  results.arrays = {{.name = "distance", .values = distance}};
  results.shown = {{.name = "signed_distance", .values = distance}};
  return results;
}

}  // namespace
}  // namespace signed_distance_command

void addSignedDistance(CLI::App& app, Run& run) {
  using namespace signed_distance_command;
  const auto [command, settings] =
      addOperatorCommand<Settings>(app, run, "signed-distance", description, footer, compute, check);
  addOrienting(*command, settings->orienting);
  command->add_option("--curve", settings->file, "Text file of the points along the curve in order, an INDEX per line")
      ->check(notEmpty)
      ->required()
      ->type_name("TEXT");
  addTimeStep(*command, settings->time_step, "Time step in mean squared edges; larger values bridge wider gaps (4)");
}
