#include "subcommand.h"

namespace {

struct Normals : Subcommand {
  explicit Normals(CLI::App& app)
      : Subcommand(app, "normals", "Compute normals that face the sensor, or that consistently point outwards.",
                   R"(Example:
  tufted normals scan.ply --out normals

The normal of a point is that of the plane through its neighbours; on a mesh it is that of the triangles.
If the position of the sensor is known (--viewpoint, VIEWPOINT of a file, or the origin for a depth image), each normal
faces it. Otherwise, and with --consistent, the normals of neighbours agree on each component, and point outwards if it
encloses a volume. An open sheet has no outside: its normals point along --up AXIS, or without it to the side to which
the sheet bulges. On a plane the largest coordinate of the mean normal is positive.

Files in DIR, which replace older ones when all are complete:
  normals.npy  N x 3, float64, of unit length; 0 at points that are not finite
  points.ply   the points with the normals, float32; points.pcd with --format pcd
  report.json  orientation, components, reversed normals, pairs of neighbours that disagree, seconds)") {
    addOrienting(command, orienting);
  }

  void check(const Operator& source) override { checkFrames(source); }

  Results compute(Operator& source) override {
    Results results;
    source.laplacian.frames = orientedFrames(orienting, source, results);
    // The copies of the points get these normals, not those of the file.
    source.geometry.normals = {};
    results.arrays = {{.name = "normals", .values = source.laplacian.frames.normals, .per_point = false}};
    return results;
  }

  Orienting orienting;

  std::vector<std::string> files() const override { return {"normals.npy"}; }
};

}  // namespace

void addNormals(CLI::App& app, Run& run) {
  addSubcommand<Normals>(app, run);
}
