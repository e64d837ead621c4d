#include "subcommand.h"
#include "tufted/distance.h"
#include "tufted/path.h"
#include "tufted/surface_triangles.h"

namespace {

struct Path : Subcommand {
  explicit Path(CLI::App& app)
      : Subcommand(app, "path", "Find a shortest path between two points along the surface.", R"(Examples:
  tufted path scan.ply --from 0 --to 99 --out path
  tufted path mesh.off --from 1,0,0 --to -1,0,0 --out path
  tufted path mesh.off --from 1,0,0 --via 0,1,0 --to -1,0,0 --closed --out loop

A first path descends the distance from --to to --from. It is then straightened across the triangles until no path close
to it is shorter. --via says on which side of handles and hills it passes: the way through these points is straightened,
and need not pass them in the end. With --closed it leads back to --from: a loop, which keeps none of the points, and
contracts to a single one where nothing holds it.

Files in DIR, which replace older ones when all are complete:
  path.npy      K x 3, float64: the two ends, and where the path crosses edges between points; of a loop the first
                point again at the end
  lines.ply     the path as points and the edges between them
  lines.obj     the path as points and an element l
  lines.svg     a plan of the path to scale, seen from above, y up
  distance.npy  N distances from --from, float64, as `tufted distance` computes them
  points.ply    the points with the field distance, float32; points.pcd with --format pcd
  report.json   ends, length, seconds)",
                   R"(--format npz,ply,cover --out DIR` wrote: the path
needs the triangles of the cover.)") {
    cover = CoverUse::all;
    command
        .add_option("--from", from,
                    "Start of the path: index of a point, or a position, which stands for the nearest point")
        ->required()
        ->type_name("I|X,Y,Z");
    command
        .add_option("--to", to, "End of the path: index of a point, or a position, which stands for the nearest point")
        ->required()
        ->type_name("I|X,Y,Z");
    command
        .add_option("--via", via,
                    "A point through which the way leads before it is straightened: as --from; may be repeated")
        ->allow_extra_args(false)
        ->type_name("I|X,Y,Z");
    command.add_flag("--closed", is_closed,
                     "Straighten the way back to --from as well: a loop, which keeps none of the points");
  }

  void check(const Operator& source) override {
    const auto add = [&](const std::string& option, const std::string& text) {
      stops.push_back(placeOf(parseNumbers(text, option), source, option + " " + text));
    };
    add("--from", from);
    for (const std::string& text : via) add("--via", text);
    add("--to", to);
  }

  /// The way through points, straightened; of a cloud on its triangles, which do not overlap.
  tufted::SurfacePath wayThrough(std::vector<int> points, const Operator& source) const {
    const tufted::PathOptions options = {source.threads, source.progress};
    if (source.laplacian.kind == tufted::Kind::mesh)
      return tufted::PathSolver(source.laplacian, options).through(points, is_closed, source.progress);
    for (int& point : points) point = source.laplacian.representative[point];
    const tufted::Laplacian on_triangles =
        tufted::meshLaplacian(source.laplacian.positions, joinedTriangles(source),
                              {.mollify = 0, .threads = source.threads, .progress = source.progress});
    return tufted::PathSolver(on_triangles, options).through(points, is_closed, source.progress);
  }

  Results compute(Operator& source) override {
    Results results;
    const std::vector<int> points = locate(stops, source, results);
    requireTakingPart(points, source);
    const tufted::SurfacePath path = blameSurface(source, [&] {
      if (points.size() > 2 || is_closed) return wayThrough(points, source);
      const tufted::PathSolver solver(source.laplacian, {source.threads, source.progress});
      return solver.query(points.front(), points.back(), source.progress);
    });
    const tufted::DistanceSolver distances(source.laplacian, {.solver = source.solverOptions()});
    Eigen::MatrixXd drawn = path.points;
    if (is_closed) {
      drawn.conservativeResize(drawn.rows() + 1, 3);
      drawn.bottomRows(1) = drawn.topRows(1);
    }
    results.arrays = {{.name = "path", .values = drawn, .per_point = false},
                      {.name = "distance", .values = distances.query({points.front()}, nullptr, source.progress)}};
    results.lines = {{.points = path.points, .is_closed = is_closed, .length = path.length}};
    results.report["from_point"] = points.front();
    if (points.size() > 2) results.report["via_points"] = std::vector<int>(points.begin() + 1, points.end() - 1);
    results.report["to_point"] = points.back();
    results.report["closed"] = is_closed;
    results.report["length"] = path.length;
    results.report["shortenings"] = path.shortenings;
    results.summary.add("length", "%.6g, %lld points", path.length, static_cast<long long>(path.points.rows()));
    return results;
  }

  std::string from, to;
  std::vector<std::string> via;
  bool is_closed = false;
  std::vector<Place> stops;

  std::vector<std::string> files() const override {
    return {"path.npy", "distance.npy", "lines.ply", "lines.obj", "lines.svg"};
  }
};

}  // namespace

void addPath(CLI::App& app, Run& run) {
  addSubcommand<Path>(app, run);
}
