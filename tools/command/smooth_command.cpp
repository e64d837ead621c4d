#include <CLI/CLI.hpp>
#include <limits>
#include <map>
#include <optional>
#include <string>

#include "command.h"
#include "moved_points.h"
#include "operator.h"
#include "options.h"
#include "point_options.h"
#include "signal_options.h"
#include "tufted/errors.h"
#include "tufted/smoothing.h"

namespace smooth_command {
namespace {

constexpr const char* description = "Smooth the positions of the points, or values at the points.";

constexpr const char* footer =
    R"(Examples:
  tufted smooth scan.ply --time-step 4 --out smooth
  tufted smooth mesh.off --method taubin --iterations 20 --out fair
  tufted smooth mesh.off --time-step 10 --keep-volume --out round

  implicit  takes steps of the heat equation of any size. Values stay within their former range, and shapes shrink.
  taubin    alternates a step towards the mean of the neighbours (--lambda) and a step away from it (--mu), which hardly
            shrinks shapes
--keep-volume scales each component about its centre of mass. All components must be closed, except for small holes of
clouds. With --denoise the moved points are smoothed, with --operator those of points.ply.

Files in DIR, which replace older ones when all are complete:
  positions.npy  N x 3, float64; points that are not finite or isolated stay, coincident points lie where their
                 representative does
  smoothed.npy   with --field or --values, instead of positions.npy: N values, or N x c for c columns, float64
  points.ply     the moved points, without normals; with --field or --values the points of FILE with the field smoothed,
                 float32; points.pcd with --format pcd
  report.json    method, its parameters, the largest and the mean displacement of a point
`tufted help laplacian` explains FILE and the options of building. --operator DIR reads L and M that
`tufted laplacian --out DIR` wrote. --keep-volume also needs the cover: --format npz,ply,cover.)";

using tufted::SmoothingMethod;

const std::map<std::string, SmoothingMethod> methods = {{"implicit", SmoothingMethod::implicit},
                                                        {"taubin", SmoothingMethod::taubin}};

struct Settings {
  OperatorSettings source;
  SignalOptions signals;
  SmoothingMethod method = SmoothingMethod::implicit;
  std::optional<double> time_step, lambda, mu;
  int iterations = 1;
  bool keep_volume = false;
  std::filesystem::path fixed_file;
  Eigen::MatrixXd values;  ///< 0 columns: positions are smoothed
  std::vector<std::uint8_t> fixed;

  bool hasSignals() const { return !signals.fields.empty() || !signals.values.empty(); }
  std::vector<std::string> files() const { return {hasSignals() ? "smoothed.npy" : "positions.npy"}; }
};

void check(Settings& settings, const Operator& source) {
  const bool is_taubin = settings.method == SmoothingMethod::taubin;
  if (is_taubin && settings.time_step) throw tufted::InvalidInput("--time-step needs --method implicit");
  if (!is_taubin && (settings.lambda || settings.mu))
    throw tufted::InvalidInput(std::string(settings.lambda ? "--lambda" : "--mu") + " needs --method taubin");
  if (settings.hasSignals()) {
    if (settings.keep_volume) throw tufted::InvalidInput("--keep-volume excludes --field and --values");
    settings.values = readSignals(settings.signals, source);
    settings.source.shown = {{"smoothed", settings.values.cols()}};
  } else {
    checkHasPoints(source);
    settings.source.shown = {{moved_points_field}};
  }
  if (settings.fixed_file.empty()) return;
  if (settings.keep_volume) throw tufted::InvalidInput("--keep-volume excludes --fixed");
  settings.fixed.assign(static_cast<std::size_t>(source.points()), 0);
  for (const Row& row : readRows(settings.fixed_file))
    settings.fixed[static_cast<std::size_t>(indexOf(row, source))] = 1;
}

Results compute(Settings& settings, Operator& source) {
  Results results;
  tufted::SmoothingOptions options = {.method = settings.method,
                                      .iterations = settings.iterations,
                                      .fixed = settings.fixed.empty() ? nullptr : &settings.fixed,
                                      .solver = source.solverOptions()};
  options.time_step = settings.time_step.value_or(options.time_step);
  options.lambda = settings.lambda.value_or(options.lambda);
  options.mu = settings.mu.value_or(options.mu);
  const bool is_taubin = settings.method == SmoothingMethod::taubin;
  results.report["report"] = {{"method", is_taubin ? "taubin" : "implicit"}, {"iterations", options.iterations}};
  nlohmann::ordered_json& report = results.report["report"];
  if (is_taubin) {
    report["lambda"] = options.lambda;
    report["mu"] = options.mu;
  } else {
    report["time_step"] = options.time_step;
  }
  report["keep_volume"] = settings.keep_volume;
  if (settings.hasSignals()) {
    requireFinite(settings.values, source);
    results.arrays = {{.name = "smoothed", .values = tufted::smoothValues(source.laplacian, settings.values, options)}};
    results.summary.add("smoothed", "%lld columns", static_cast<long long>(settings.values.cols()));
    return results;
  }
  tufted::Triangles triangles;
  if (settings.keep_volume) {
    triangles = trianglesOf(source);
    options.volume_of = &triangles;
  }
  const tufted::Points moved =
      blameSurface(source, [&] { return tufted::smooth(source.laplacian, source.startingPoints(), options); });
  movePoints("positions", moved, source, results);
  return results;
}

}  // namespace
}  // namespace smooth_command

void addSmooth(CLI::App& app, Run& run) {
  using namespace smooth_command;
  const auto [command, settings] =
      addOperatorCommand<Settings>(app, run, "smooth", description, footer, compute, check);
  constexpr double least = std::numeric_limits<double>::min(), most = 1e10;
  addChoice(*command, "--method", settings->method, methods,
            "implicit: heat equation, shrinks the shape; taubin: hardly shrinks it (implicit)");
  addNumber(*command, "--time-step", settings->time_step, least, most,
            "With --method implicit: time step in mean squared edges of each component; larger values smooth more (1)")
      ->type_name("T");
  addNumber(*command, "--lambda", settings->lambda, least, 1.0,
            "With --method taubin: fraction of the way to the mean of the neighbours (0.5)")
      ->type_name("L");
  addNumber(*command, "--mu", settings->mu, -1.0, 0.0,
            "With --method taubin: fraction of the way in the step back, negative (-0.53)")
      ->type_name("MU");
  addNumber(*command, "--iterations", settings->iterations, 1, 1000000, "Number of steps (1)")->type_name("N");
  command->add_flag_callback(
      "--keep-volume",
      [settings = settings.get()] {
        settings->keep_volume = true;
        settings->source.cover = CoverUse::clouds;
      },
      "Scale each component to its former volume; all components must be closed");
  command->add_option("--fixed", settings->fixed_file, "Text file of points that stay, an INDEX per line (none)")
      ->check(notEmpty)
      ->type_name("TEXT");
  addSignalOptions(*command, settings->signals, "Values to smooth instead of the positions");
}
