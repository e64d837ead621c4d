#include "subcommand.h"
#include "tufted/mean_curvature_flow.h"
#include "tufted/smoothing.h"

namespace {

enum class Way : std::uint8_t { implicit, taubin, flow };

struct Smooth : Subcommand {
  explicit Smooth(CLI::App& app)
      : Subcommand(app, "smooth", "Smooth the positions of the points, or values at the points.", R"(Examples:
  tufted smooth scan.ply --time-step 4 --out smooth
  tufted smooth mesh.off --method taubin --iterations 20 --out fair
  tufted smooth mesh.off --time-step 10 --keep-volume --out round
  tufted smooth mesh.off --method flow --iterations 20 --out ball

  implicit  takes steps of the heat equation of any size. Values stay within their former range, and shapes shrink.
  taubin    alternates a step towards the mean of the neighbours (--lambda) and a step away from it (--mu), which hardly
            shrinks shapes
  flow      conformalised mean curvature flow: a closed surface without handles becomes a sphere of the same area.
            Coarse samples leave the sphere again after tens of steps
--keep-volume scales each component about its centre of mass. All components must be closed, except for small holes of
clouds. With --denoise the moved points are smoothed, with --operator those of points.ply; flow always starts from
the points of the Laplacian.

Files in DIR, which replace older ones when all are complete:
  positions.npy  N x 3, float64; points that are not finite or isolated stay, coincident points lie where their
                 representative does
  smoothed.npy   with --field or --values, instead of positions.npy: N values, or N x c for c columns, float64
  points.ply     the moved points, without normals; with --field or --values the points of FILE with the field smoothed,
                 float32; points.pcd with --format pcd
  report.json    method, its parameters, the largest and the mean displacement of a point)",
                   R"(--out DIR` wrote. --keep-volume and flow also need the cover: --format npz,ply,cover.)") {
    constexpr double least = std::numeric_limits<double>::min(), most = 1e10;
    addChoice(command, "--method", way, ways,
              "implicit: heat equation, shrinks the shape; taubin: hardly shrinks it; flow: rounds it off (implicit)")
        ->each([this](const std::string& name) {
          if (name == "flow") cover = CoverUse::clouds;
        });
    addNumber(
        command, "--time-step", time_step, least, most,
        "Larger values smooth more; with --method implicit in mean squared edges of each component (1), with flow "
        "as a share of its area (0.01)")
        ->type_name("T");
    addNumber(command, "--lambda L", lambda, least, 1.0,
              "With --method taubin: fraction of the way to the mean of the neighbours (0.5)");
    addNumber(command, "--mu MU", mu, -1.0, 0.0,
              "With --method taubin: fraction of the way in the step back, negative (-0.53)");
    addNumber(command, "--iterations N", iterations, 1, 1000000, "Number of steps (1; flow: 10)");
    command.add_flag_callback(
        "--keep-volume",
        [this] {
          keep_volume = true;
          cover = CoverUse::clouds;
        },
        "Scale each component to its former volume; all components must be closed");
    addText(command, "--fixed TEXT", fixed_file, "Text file of points that stay, an INDEX per line (none)");
    addSignalOptions(command, signals, "Values to smooth instead of the positions");
  }

  static inline const std::map<std::string, Way> ways = {
      {"implicit", Way::implicit}, {"taubin", Way::taubin}, {"flow", Way::flow}};

  void check(const Operator& source) override {
    if (way == Way::taubin && time_step) throw tufted::InvalidInput("--time-step needs --method implicit or flow");
    if (way == Way::flow && (keep_volume || !fixed_file.empty() || hasSignals()))
      throw tufted::InvalidInput("--method flow excludes --keep-volume, --fixed, --field and --values");
    if (way != Way::taubin && (lambda || mu))
      throw tufted::InvalidInput(std::string(lambda ? "--lambda" : "--mu") + " needs --method taubin");
    if (hasSignals()) {
      if (keep_volume) throw tufted::InvalidInput("--keep-volume excludes --field and --values");
      values = readSignals(signals, source);
      shown = {{"smoothed", values.cols()}};
    } else {
      checkHasPoints(source);
      shown = {{moved_points_field}};
    }
    if (fixed_file.empty()) return;
    if (keep_volume) throw tufted::InvalidInput("--keep-volume excludes --fixed");
    fixed.assign(static_cast<std::size_t>(source.points()), 0);
    for (const Row& row : readRows(fixed_file)) fixed[static_cast<std::size_t>(indexOf(row, source))] = 1;
  }

  Results compute(Operator& source) override {
    if (way == Way::flow) return computeFlow(source);
    Results results;
    const bool is_taubin = way == Way::taubin;
    using tufted::SmoothingMethod;
    tufted::SmoothingOptions options = {.method = is_taubin ? SmoothingMethod::taubin : SmoothingMethod::implicit,
                                        .iterations = iterations.value_or(1),
                                        .fixed = fixed.empty() ? nullptr : &fixed,
                                        .solver = source.solverOptions()};
    options.time_step = time_step.value_or(options.time_step);
    options.lambda = lambda.value_or(options.lambda);
    options.mu = mu.value_or(options.mu);
    results.report["report"] = {{"method", is_taubin ? "taubin" : "implicit"}, {"iterations", options.iterations}};
    nlohmann::ordered_json& report = results.report["report"];
    if (is_taubin) {
      report["lambda"] = options.lambda;
      report["mu"] = options.mu;
    } else {
      report["time_step"] = options.time_step;
    }
    report["keep_volume"] = keep_volume;
    if (hasSignals()) {
      requireFinite(values, source);
      results.arrays = {{.name = "smoothed", .values = tufted::smoothValues(source.laplacian, values, options)}};
      results.summary.add("smoothed", "%lld columns", static_cast<long long>(values.cols()));
      return results;
    }
    tufted::Triangles triangles;
    if (keep_volume) {
      triangles = trianglesOf(source);
      options.volume_of = &triangles;
    }
    const tufted::Points moved =
        blameSurface(source, [&] { return tufted::smooth(source.laplacian, source.startingPoints(), options); });
    movePoints("positions", moved, source, results);
    return results;
  }

  Results computeFlow(Operator& source) {
    Results results;
    tufted::MeanCurvatureFlowOptions options = {.solver = source.solverOptions()};
    options.time_step = time_step.value_or(options.time_step);
    options.steps = iterations.value_or(options.steps);
    results.report["report"] = {{"method", "flow"}, {"iterations", options.steps}, {"time_step", options.time_step}};
    const tufted::Triangles triangles = trianglesOf(source);
    const tufted::Points moved =
        blameSurface(source, [&] { return tufted::meanCurvatureFlow(source.laplacian, triangles, options); });
    movePoints("positions", moved, source, results);
    return results;
  }

  SignalOptions signals;
  Way way = Way::implicit;
  std::optional<double> time_step, lambda, mu;
  std::optional<int> iterations;
  bool keep_volume = false;
  std::filesystem::path fixed_file;
  Eigen::MatrixXd values;  ///< 0 columns: positions are smoothed
  std::vector<std::uint8_t> fixed;

  bool hasSignals() const { return !signals.fields.empty() || !signals.values.empty(); }
  std::vector<std::string> files() const override { return {hasSignals() ? "smoothed.npy" : "positions.npy"}; }
};

}  // namespace

void addSmooth(CLI::App& app, Run& run) {
  addSubcommand<Smooth>(app, run);
}
