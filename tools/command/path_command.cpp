#include "subcommand.h"
#include "tufted/distance.h"
#include "tufted/path.h"

namespace {

struct Path : Subcommand {
  explicit Path(CLI::App& app)
      : Subcommand(app, "path", "Find a shortest path between two points along the surface.", R"(Examples:
  tufted path scan.ply --from 0 --to 99 --out path
  tufted path mesh.off --from 1,0,0 --to -1,0,0 --out path

A first path descends the distance from --to to --from. It is then straightened across the triangles until no path close
to it is shorter.

Files in DIR, which replace older ones when all are complete:
  path.npy      K x 3, float64: the two ends, and where the path crosses edges between points
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
  }

  void check(const Operator& source) override {
    ends = {placeOf(parseNumbers(from, "--from"), source, "--from " + from),
            placeOf(parseNumbers(to, "--to"), source, "--to " + to)};
  }

  Results compute(Operator& source) override {
    Results results;
    const std::vector<int> found = locate(ends, source, results);
    requireTakingPart(found, source);
    const tufted::PathSolver solver(source.laplacian, {source.threads, source.progress});
    const tufted::SurfacePath path =
        blameSurface(source, [&] { return solver.query(found[0], found[1], source.progress); });
    const tufted::DistanceSolver distances(source.laplacian, {.solver = source.solverOptions()});
    results.arrays = {{.name = "path", .values = path.points, .per_point = false},
                      {.name = "distance", .values = distances.query({found[0]}, nullptr, source.progress)}};
    results.lines = {{.points = path.points, .length = path.length}};
    results.report["from_point"] = found[0];
    results.report["to_point"] = found[1];
    results.report["length"] = path.length;
    results.report["shortenings"] = path.shortenings;
    results.summary.add("length", "%.6g, %lld points", path.length, static_cast<long long>(path.points.rows()));
    return results;
  }

  std::string from, to;
  std::vector<Place> ends;

  std::vector<std::string> files() const override {
    return {"path.npy", "distance.npy", "lines.ply", "lines.obj", "lines.svg"};
  }
};

}  // namespace

void addPath(CLI::App& app, Run& run) {
  addSubcommand<Path>(app, run);
}
