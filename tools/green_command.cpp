#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "command.h"
#include "operator.h"
#include "point_options.h"
#include "progress_bar.h"
#include "tufted/errors.h"
#include "tufted/interpolation.h"

namespace {

constexpr const char* description = "Green's function of points: L g = delta - M / area, with mean 0.";

constexpr const char* footer = R"(Writes into DIR, renamed one after the other when all are complete:
  green.npy    N values, or N x c for c points, float64; 0 in other components, NaN at points that take no part
  points.ply   the points with the field green, float32; points.pcd with --format pcd
  report.json  iterations, residual, seconds
FILE and the options of building are those of `tufted laplacian`; --operator takes what that has written.)";

struct Settings {
  OperatorSettings source;
  NamedPoints points;
};

int runGreen(Settings& settings) {
  ProgressBar bar;
  const tufted::Progress progress = showOn(bar);
  const Operator source =
      loadOperator(settings.source, {"green.npy", "points.ply", "points.pcd", "report.json"}, false, progress);
  const std::vector<int> points = indicesOf(settings.points, source);
  tufted::SolveReport made;
  Eigen::MatrixXd green = tufted::greensFunction(source.laplacian, points,
                                                 {.threads = settings.source.threads(), .progress = progress}, &made);
  const nlohmann::ordered_json report = {
      {"sources", points},
      {"report", {{"iterations", made.iterations}, {"residual", made.residual}, {"seconds", made.seconds}}}};
  writeOperatorResults(settings.source, "green", source, {{.name = "green", .values = std::move(green)}}, report.dump(),
                       progress);
  bar.clear();
  std::printf("%-15s %zu\n", "points", points.size());
  std::printf("%-15s residual %.1e, %.3g s\n", "solve", made.residual, made.seconds);
  std::printf("%-15s %s\n", "written to", settings.source.out.c_str());
  if (std::fflush(stdout) != 0) throw tufted::IoError("standard output: cannot write the summary");
  return exit_done;
}

}  // namespace

void addGreen(CLI::App& app, Run& run) {
  CLI::App& command = *app.add_subcommand("green", description);
  command.footer(footer);
  const auto settings = std::make_shared<Settings>();
  addOperatorOptions(command, settings->source);
  addPointOptions(command, settings->points, "Points, a column for each");
  command.callback([&run, settings] { run = [=] { return runGreen(*settings); }; });
}
