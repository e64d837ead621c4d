#include "subcommand.h"
#include "tufted/distance.h"

namespace {

struct Distance : Subcommand {
  explicit Distance(CLI::App& app)
      : Subcommand(app, "distance", "Compute the geodesic distance of every point from the nearest source.",
                   R"(Examples:
  tufted distance scan.ply --source 0 --out distance
  tufted distance scan.ply --near 1,2,0.5 --within 0.3 --out around
  tufted distance scan.ply --source 0,17,99 --labels --out cells
  tufted distance scan.ply --source 0,17,99 --matrix --out landmarks

Distances are in the unit of FILE. They are 0 at sources, and infinite beyond --within and where no path leads: in other
components and at isolated points. The summary names the point that --near found. If that point is farther from the
position than from its own neighbours, a warning says so.

  marching  the front passes from triangle to triangle, with the source unfolded into the plane of each. This method is
            more accurate and needs no factorisation. On meshes each --split lowers the error to 0.6 of its value and
            takes three to four times as long. With --within, up to 64 sources, and without --labels, --matrix and
            --face, only the surface around the sources is prepared.
  heat      the distance is smooth where fronts meet. --time-step, --time-unit, --solver and --memory-limit apply to
            this method only.

Files in DIR, which replace older ones when all are complete:
  distance.npy  N distances, float64; with --matrix N x K, a column for each source. Between two sources, distances
                found from either end differ by up to 6 % of the largest; --symmetric writes their mean
  labels.npy    with --labels: N numbers of the nearest source, int32, from 0 in the order --source, --near, --sources,
                --face; -1 where no path leads
  points.ply    the points with the field distance, float32; points.pcd with --format pcd
  report.json   sources, method, counts of the query, seconds)",
                   R"(--format npz,ply,cover --out DIR` wrote: distances
need the triangles of the cover.)") {
    cover = CoverUse::all;
    addPointOptions(command, points, "Sources");
    addFaceOption(command, faces, "Source");
    addChoice(command, "--method", options.method, methods,
              "marching: more accurate; heat: smooth where fronts meet (marching)");
    addNumber(command, "--split TIMES", options.split, 0, 2,
              "With --method marching: how often each triangle is divided into four (2 up to 5,000 points, else 1)");
    addNumber(command, "--within R", options.maximum, std::numeric_limits<double>::min(),
              std::numeric_limits<double>::max(),
              "Longest distance that is computed, in the unit of FILE; beyond it infinite (no limit)");
    CLI::Option* const labels_flag =
        command.add_flag("--labels", labels, "Also write the number of the nearest source of each point, labels.npy");
    CLI::Option* const matrix_flag =
        command
            .add_flag("--matrix", matrix,
                      "Write a column of distances for each source, instead of those from the nearest")
            ->excludes(labels_flag);
    command
        .add_flag("--symmetric", symmetric,
                  "With --matrix: distances between sources are the mean of those found from either end")
        ->needs(matrix_flag);
    addTimeStep(command, time_step,
                "With --method heat: time step in units of --time-unit; larger values smooth more (0.5)");
    addChoice(command, "--time-unit", time_unit, units,
              "With --method heat: mean squared edge; adapted: weighted by area, for very uneven density (mean)");
  }

  /// Up to this many sources, distances within a radius are computed around each, without a solver for the whole
  /// surface.
  static constexpr std::size_t few_sources = 64;

  static inline const std::map<std::string, tufted::TimeUnit> units = {{"mean", tufted::TimeUnit::mean_edge},
                                                                       {"adapted", tufted::TimeUnit::adapted_edge}};

  static inline const std::map<std::string, tufted::DistanceMethod> methods = {
      {"marching", tufted::DistanceMethod::marching}, {"heat", tufted::DistanceMethod::heat}};

  /// @throws InvalidInput for options of the other method
  void checkMethod() const {
    if (symmetric && !faces.empty())
      throw tufted::InvalidInput("--symmetric needs sources at points, so it excludes --face");
    const bool is_heat = options.method == tufted::DistanceMethod::heat;
    if (!is_heat && time_step) throw tufted::InvalidInput("--time-step applies to --method heat");
    if (!is_heat && time_unit) throw tufted::InvalidInput("--time-unit applies to --method heat");
    if (is_heat && options.split) throw tufted::InvalidInput("--split applies to --method marching");
  }

  void check(const Operator& source) override {
    checkMethod();
    places = points.places(source);
    inside = pointsInFaces(faces, source);
    if (places.empty() && inside.empty())
      throw tufted::InvalidInput("no source is given, must be at least one by --source, --near, --sources or --face");
    stages = {{"faces", 26, 2}, {"edges", 3}, {"march", 18}};
    if (options.method == tufted::DistanceMethod::heat)
      stages = {{"faces", 26},  {"analyse", 15}, {"factor", 33}, {"analyse", 15},
                {"factor", 33}, {"analyse", 15}, {"factor", 33}, {"solve", 6, 3}};
    if (matrix) shown = {{"distance", std::ssize(places) + std::ssize(inside)}};
  }

  /// N distances from the nearest source. With --labels adds to the results which source that is.
  Eigen::MatrixXd addNearest(const tufted::DistanceSolver& solver, const std::vector<tufted::SurfacePoint>& sources,
                             const Operator& source, tufted::DistanceReport& made, Results& results) const {
    if (!labels) return solver.queryAt(sources, &made, source.progress);
    const tufted::NearestSources found = solver.nearest(sources, &made, source.progress);
    results.arrays.push_back({.name = "labels", .values = columnOf(found.source), .is_integer = true});
    return found.distance;
  }

  /// Whether pointsWithin() suffices, which visits only the surface around the sources.
  bool isLocal() const {
    return options.method == tufted::DistanceMethod::marching && std::isfinite(options.maximum) && !labels && !matrix &&
           inside.empty() && places.size() <= few_sources;
  }

  /// N distances by pointsWithin(), infinite beyond --within.
  Eigen::MatrixXd addNearby(const std::vector<tufted::SurfacePoint>& sources, const Operator& source,
                            Results& results) const {
    std::vector<int> vertices;
    for (const tufted::SurfacePoint& point : sources) vertices.push_back(point.corners[0]);
    const auto start = std::chrono::steady_clock::now();
    const tufted::NearbyPoints near =
        tufted::pointsWithin(source.laplacian, vertices, options.maximum, options.split, source.progress);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    Eigen::MatrixXd distance = Eigen::MatrixXd::Constant(source.points(), 1, std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < near.points.size(); ++i) distance(near.points[i], 0) = near.distances[i];
    results.report["report"] = {{"seconds", seconds}};
    results.summary.addDetail("query", "the surface around the sources alone, %.3g s", seconds);
    return distance;
  }

  /// N x 1 or N x K distances by a solver for the whole surface.
  Eigen::MatrixXd addSolved(const std::vector<tufted::SurfacePoint>& sources, const Operator& source,
                            Results& results) const {
    const tufted::DistanceSolver solver(source.laplacian, options);
    checkTimeStep(time_step, solver.timeStep(), source);
    tufted::DistanceReport made;
    Eigen::MatrixXd distance = matrix ? solver.matrix(sources, symmetric, &made, source.progress)
                                      : addNearest(solver, sources, source, made, results);
    if (solver.timeStep() > 0) results.report["time_step"] = solver.timeStep();
    addReport(made, solver.report(), results);
    return distance;
  }

  /// @throws InvalidInput for a radius so small that no other point can be within it
  void checkWithin(const Operator& source) const {
    constexpr double nearest = 0.01;  // least radius, in spacings
    const Extent extent = extentOf(source);
    if (options.maximum < nearest * extent.spacing)
      throw tufted::InvalidInput("--within " + numberText(options.maximum) +
                                 " is less than a hundredth of the spacing: " + extent.text());
  }

  Results compute(Operator& source) override {
    checkWithin(source);
    Results results;
    std::vector<tufted::SurfacePoint> sources;
    const std::vector<int> named = locate(places, source, results);
    noteLeftOut(named, source, results, !inside.empty());
    for (const int point : named) sources.push_back(tufted::SurfacePoint::vertex(point));
    sources.insert(sources.end(), inside.begin(), inside.end());
    options.solver = source.solverOptions();
    if (time_step) options.time_step = *time_step;
    if (time_unit) options.unit = *time_unit;
    results.report["sources"] = nlohmann::ordered_json::array();
    for (const tufted::SurfacePoint& point : sources)
      results.report["sources"].push_back({{"corners", point.corners}, {"weights", point.weights}});
    results.report["method"] = options.method == tufted::DistanceMethod::heat ? "heat" : "marching";
    const Eigen::MatrixXd distance =
        isLocal() ? addNearby(sources, source, results) : addSolved(sources, source, results);
    results.arrays.insert(results.arrays.begin(), {.name = "distance", .values = distance});
    long long reached = 0;
    double farthest = 0;
    for (const double d : distance.rowwise().minCoeff()) {
      if (!std::isfinite(d)) continue;
      ++reached;
      farthest = std::max(farthest, d);
    }
    results.summary.add("reached", "%lld of %lld, the farthest at %.6g", reached,
                        static_cast<long long>(distance.rows()), farthest);
    return results;
  }

  NamedPoints points;
  std::vector<std::string> faces;
  tufted::DistanceOptions options;
  std::optional<double> time_step;
  std::optional<tufted::TimeUnit> time_unit;
  bool labels = false, matrix = false, symmetric = false;
  std::vector<Place> places;
  std::vector<tufted::SurfacePoint> inside;  ///< sources inside faces

  std::vector<std::string> files() const override {
    std::vector<std::string> names = {"distance.npy"};
    if (labels) names.emplace_back("labels.npy");
    return names;
  }
};

}  // namespace

void addDistance(CLI::App& app, Run& run) {
  addSubcommand<Distance>(app, run);
}
