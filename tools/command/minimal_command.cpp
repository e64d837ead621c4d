#include "subcommand.h"
#include "tufted/minimal_surface.h"

namespace {

struct Minimal : Subcommand {
  explicit Minimal(CLI::App& app)
      : Subcommand(app, "minimal", "Find the surface of least area that a rim, or given points, span.", R"(Examples:
  tufted minimal open.off --out soap
  tufted minimal open.off --fixed rim.txt --out soap

The points of the rim stay in place, or with --fixed those in the text file. All others move until each is a mean of its
neighbours, with weights of the surface at its present position. The triangles of a cloud are those of
`tufted laplacian --format triangles`.

Files in DIR, which replace older ones when all are complete:
  positions.npy  N x 3, float64; points without a triangle, and points of parts without a fixed point, stay
  points.ply     the moved points, without normals; points.pcd with --format pcd
  report.json    fixed and moved points, area before and after, iterations, whether they converged, seconds)",
                   R"(--format npz,ply,cover --out DIR` wrote: clouds
need the cover, and meshes only their triangles in points.ply.)") {
    cover = CoverUse::clouds;
    addText(command, "--fixed TEXT", fixed, "Text file of points that stay, an INDEX per line (the points of the rim)");
    addNumber(command, "--iterations N", options.max_iterations, 1, 1000000, "Maximum number of iterations (300)");
    addNumber(command, "--tolerance T", options.tolerance, std::numeric_limits<double>::min(), 1.0,
              "Stop when no point moves off the surface by more than T times the extent of the surface (1e-4)");
  }

  void check(const Operator& source) override {
    shown = {{moved_points_field}};
    checkPositions(source);
    checkHasPoints(source);
    if (fixed.empty()) return;
    for (const Row& row : readRows(fixed)) options.fixed.push_back(indexOf(row, source));
    if (options.fixed.empty()) throw tufted::IoError(fixed.string() + ": names no point, must name one");
  }

  Results compute(Operator& source) override {
    Results results;
    options.solver = source.solverOptions();
    tufted::MinimalSurfaceReport made;
    const tufted::Points moved = blameSurface(
        source, [&] { return tufted::minimalSurface(source.laplacian, trianglesOf(source), options, &made); });
    results.report["report"] = {{"fixed", made.fixed},
                                {"moved", made.moved},
                                {"floating", made.floating},
                                {"iterations", made.iterations},
                                {"last_move", made.last_move},
                                {"converged", made.converged},
                                {"area_before", made.area_before},
                                {"area", made.area},
                                {"seconds", made.seconds}};
    results.summary.add("points", "%lld stayed, %lld moved", static_cast<long long>(made.fixed),
                        static_cast<long long>(made.moved));
    results.summary.add("area", "%.6g, before %.6g", made.area, made.area_before);
    results.summary.add("iterations", "%d, in the last one points left the surface by at most %.3g", made.iterations,
                        made.last_move);
    if (made.floating > 0)
      results.warnings.push_back(std::to_string(made.floating) +
                                 " points lie on parts without a fixed point; they stay");
    if (!made.converged)
      results.warnings.push_back("the surface still moves by " + numberText(made.last_move) +
                                 "; --iterations was too small");
    movePoints("positions", moved, source, results);
    return results;
  }

  std::filesystem::path fixed;
  tufted::MinimalSurfaceOptions options;

  std::vector<std::string> files() const override { return {"positions.npy"}; }
};

}  // namespace

void addMinimal(CLI::App& app, Run& run) {
  addSubcommand<Minimal>(app, run);
}
