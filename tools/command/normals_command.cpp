#include <CLI/CLI.hpp>

#include "command.h"
#include "operator.h"
#include "oriented.h"

namespace normals_command {
namespace {

constexpr const char* description = "Normals, towards the sensor or consistently outwards.";

constexpr const char* footer =
    R"(Example:
  tufted normals scan.ply --out normals

Normals are those of the planes through each point's neighbours; of a mesh, those of its triangles.
Where the sensor's position is known, each faces it: --viewpoint, VIEWPOINT of a PCD file, or the origin of a depth
image. Otherwise, and with --consistent, normals agree with their neighbours' on each component, and point outwards
where it encloses a volume. An open sheet has no outside: --up AXIS, or else the side to which it bulges, decides. On a
plane the largest coordinate of the mean normal is positive.

Writes into DIR, renamed one after the other when all are complete:
  normals.npy  N x 3, float64, unit length; not finite points: 0
  points.ply   the points with the normals, float32; points.pcd with --format pcd
  report.json  orientation, components, normals turned, neighbours that disagree, seconds
FILE and the options of building are those of `tufted laplacian`; --operator takes what that has written.)";

struct Settings {
  OperatorSettings source;
  Orienting orienting;

  std::vector<std::string> files() const { return {"normals.npy"}; }
};

void check(Settings&, const Operator& source) {
  checkFrames(source);
}

Results compute(Settings& settings, Operator& source) {
  Results results;
  source.laplacian.frames = orientedFrames(settings.orienting, source, results);
  // The copies of the points get these normals, not those of the file.
  source.geometry.normals = {};
  results.arrays = {{.name = "normals", .values = source.laplacian.frames.normals, .per_point = false}};
  return results;
}

}  // namespace
}  // namespace normals_command

void addNormals(CLI::App& app, Run& run) {
  using namespace normals_command;
  const auto [command, settings] =
      addOperatorCommand<Settings>(app, run, "normals", description, footer, compute, check);
  addOrienting(*command, settings->orienting);
}
