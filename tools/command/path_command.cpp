#include <CLI/CLI.hpp>
#include <string>

#include "command.h"
#include "moved_points.h"
#include "operator.h"
#include "point_options.h"
#include "reports.h"
#include "taking_part.h"
#include "tufted/distance.h"
#include "tufted/path.h"

namespace path_command {
namespace {

constexpr const char* description = "Find a shortest path between two points along the surface.";

constexpr const char* footer =
    R"(Examples:
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
  report.json   ends, length, seconds
`tufted help laplacian` explains FILE and the options of building. --operator DIR reads L and M that
`tufted laplacian --format npz,ply,cover --out DIR` wrote: the path
needs the triangles of the cover.)";

struct Settings {
  OperatorSettings source;
  std::string from, to;
  std::vector<Place> ends;

  std::vector<std::string> files() const { return {"path.npy", "distance.npy", "lines.ply", "lines.obj", "lines.svg"}; }
};

void check(Settings& settings, const Operator& source) {
  settings.ends = {placeOf(parseNumbers(settings.from, "--from"), source, "--from " + settings.from),
                   placeOf(parseNumbers(settings.to, "--to"), source, "--to " + settings.to)};
}

Results compute(Settings& settings, Operator& source) {
  Results results;
  const std::vector<int> ends = locate(settings.ends, source, results);
  requireTakingPart(ends, source);
  const tufted::PathSolver solver(source.laplacian, {source.threads, source.progress});
  const tufted::SurfacePath path =
      blameSurface(source, [&] { return solver.query(ends[0], ends[1], source.progress); });
  const tufted::DistanceSolver distances(source.laplacian, {.solver = source.solverOptions()});
  results.arrays = {{.name = "path", .values = path.points, .per_point = false},
                    {.name = "distance", .values = distances.query({ends[0]}, nullptr, source.progress)}};
  results.lines = {{.points = path.points, .length = path.length}};
  results.report["from_point"] = ends[0];
  results.report["to_point"] = ends[1];
  results.report["length"] = path.length;
  results.report["shortenings"] = path.shortenings;
  results.summary.add("length", "%.6g, %lld points", path.length, static_cast<long long>(path.points.rows()));
  return results;
}

}  // namespace
}  // namespace path_command

void addPath(CLI::App& app, Run& run) {
  using namespace path_command;
  const auto [command, settings] = addOperatorCommand<Settings>(app, run, "path", description, footer, compute, check);
  settings->source.cover = CoverUse::all;
  command
      ->add_option("--from", settings->from,
                   "Start of the path: index of a point, or a position, which stands for the nearest point")
      ->required()
      ->type_name("I|X,Y,Z");
  command
      ->add_option("--to", settings->to,
                   "End of the path: index of a point, or a position, which stands for the nearest point")
      ->required()
      ->type_name("I|X,Y,Z");
}
