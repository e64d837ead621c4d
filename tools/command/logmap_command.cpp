#include "subcommand.h"
#include "tufted/vector_heat.h"

namespace {

struct Logmap : Subcommand {
  explicit Logmap(CLI::App& app)
      : Subcommand(app, "logmap", "Compute the logarithmic map: distance and direction of every point from a source.",
                   R"(Example:
  tufted logmap scan.ply --source 0 --out logmap

The two coordinates of a point are its geodesic distance from the source, in the direction in which its shortest path
leaves the source. The first axis is --axis, projected to the tangent plane of the source; without --axis it is any
tangent. The second axis is perpendicular to the first, counterclockwise seen from the normal of `tufted normals`.

  exact  shortest paths over the triangles, in a time that grows with N^1.5; refused where triangles are so thin that
         lines wind without an end
  heat   the vector heat method, for millions of points: angles are off by some degrees

Files in DIR, which replace older ones when all are complete:
  logmap.npy   N x 2, float64, in the unit of FILE; 0, 0 at the source, NaN where no path leads
  points.ply   the points with the fields logmap_0 and logmap_1, float32; points.pcd with --format pcd
  report.json  source, axes, method, seconds; with --method heat also rounds, residual, backward error)",
                   R"(--format npz,ply,cover --out DIR` wrote: distances
need the triangles of the cover.)") {
    cover = CoverUse::all;
    addOrienting(command, orienting);
    addPointOptions(command, points, "Source, the centre of the map");
    command.add_option("--axis", axis_text, "Direction of the first coordinate axis at the source (any tangent)")
        ->type_name("X,Y,Z");
    addChoice(command, "--method", options.method, methods,
              "exact: shortest paths; heat: less accurate, for millions of points (exact)");
  }

  static inline const std::map<std::string, tufted::LogMapMethod> methods = {{"exact", tufted::LogMapMethod::exact},
                                                                             {"heat", tufted::LogMapMethod::heat}};

  void check(const Operator& source) override {
    checkFrames(source);
    if (options.method == tufted::LogMapMethod::exact) stages = {{"paths", 100}};
    places = points.places(source);
    if (places.size() != 1)
      throw tufted::InvalidInput(std::to_string(places.size()) +
                                 " sources are given, must be one by --source or --near");
    if (axis_text.empty()) return;
    axis = parsePosition(axis_text, "--axis");
    if (axis.isZero(0)) throw tufted::InvalidInput("--axis " + axis_text + " has no direction");
  }

  Results compute(Operator& source) override {
    Results results;
    const int point = locate(places, source, results).front();
    requireTakingPart({point}, source);
    options.solver = source.solverOptions();
    const tufted::LogMapSolver solver(source.laplacian, orientedFrames(orienting, source, results), options);
    const tufted::LogMap map = solver.query(point, axis, source.progress);
    const auto direction = [](const Eigen::RowVector3d& v) { return std::vector<double>{v[0], v[1], v[2]}; };
    results.report["source_point"] = point;
    results.report["axes"] = {direction(map.first), direction(map.second)};
    results.summary.add("first axis", "%.6g, %.6g, %.6g", map.first[0], map.first[1], map.first[2]);
    results.summary.add("second axis", "%.6g, %.6g, %.6g", map.second[0], map.second[1], map.second[2]);
    const bool is_heat = options.method == tufted::LogMapMethod::heat;
    results.report["method"] = is_heat ? "heat" : "exact";
    if (is_heat) {
      addReport(map.report, solver.report(), results);
    } else {
      results.report["report"] = {{"seconds", map.report.seconds}};
      results.summary.addDetail("query", "shortest paths over the triangles, %.3g s", map.report.seconds);
    }
    results.summary.add("not reached", "%lld points, which are NaN",
                        static_cast<long long>(map.coordinates.col(0).array().isNaN().count()));
    results.arrays = {{.name = "logmap", .values = map.coordinates}};
    return results;
  }

  Orienting orienting;
  NamedPoints points;
  std::string axis_text;
  tufted::LogMapOptions options;
  std::vector<Place> places;
  Eigen::RowVector3d axis = Eigen::RowVector3d::Zero();

  std::vector<std::string> files() const override { return {"logmap.npy"}; }
};

}  // namespace

void addLogmap(CLI::App& app, Run& run) {
  addSubcommand<Logmap>(app, run);
}
