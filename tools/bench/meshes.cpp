#include <string>
#include <utility>

#include "bench/costs.h"
#include "shapes/shapes.h"
#include "tufted/laplacian.h"

namespace tufted::bench {
namespace {

struct MeshCase {
  bool is_sphere;
  int refinement;  ///< subdivisions of the icosphere, or steps along a side of the grid
  int threads;

  int triangles() const { return is_sphere ? 20 << 2 * refinement : 2 * refinement * refinement; }
  std::string name() const {
    return std::string("mesh/") + (is_sphere ? "icosphere" : "grid") + "/" + std::to_string(triangles()) + "/" +
           threadsName(threads);
  }
};

/// CPU time on one thread, otherwise wall-clock time.
void runMesh(benchmark::State& state, const MeshCase& c) {
  const shapes::Mesh mesh = c.is_sphere ? shapes::icosphere(c.refinement) : shapes::gridSquare(c.refinement);
  Costs costs(c.triangles());
  for ([[maybe_unused]] auto _ : state) {
    const BuildStopwatch watch(c.threads);
    const Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles, {.threads = c.threads});
    const double seconds = watch.seconds();
    state.SetIterationTime(seconds);
    costs.addBuild(seconds, laplacian.report);
  }
  costs.publish(state);
}

}  // namespace

void registerMeshes() {
  for (const auto& [is_sphere, refinement] : {std::pair(true, 6), {false, 224}, {true, 8}, {false, 707}}) {
    for (const int threads : {1, 0}) {
      const MeshCase c{is_sphere, refinement, threads};
      benchmark::RegisterBenchmark(c.name().c_str(), [c](benchmark::State& state) { runMesh(state, c); })
          ->UseManualTime()
          ->Iterations(iterationsFor(c.triangles()))
          ->Unit(benchmark::kMillisecond);
    }
  }
}

}  // namespace tufted::bench
