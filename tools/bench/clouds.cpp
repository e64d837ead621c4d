#include "base/stage_clock.h"
#include "bench/costs.h"
#include "cloud/morton.h"
#include "cloud/neighbors.h"
#include "shapes/shapes.h"
#include "tufted/laplacian.h"

namespace tufted::bench {
namespace {

constexpr int neighbor_count = 30;

struct CloudCase {
  int points;
  Preset preset;
  Gluing gluing;
  Delaunay delaunay;
  int threads;

  std::string name() const {
    return std::string("cloud/") + (preset == Preset::clean ? "clean/" : "scan/") +
           (delaunay == Delaunay::star ? "star" : "cgal") + "/" + (gluing == Gluing::star ? "star" : "vertex_pair") +
           "/" + std::to_string(points) + "/" + threadsName(threads);
  }
};

/// Independent random points on the unit sphere, in random order. Only the last size asked for is kept.
const Points& sphere(int n) {
  static Points points;
  if (points.rows() != n) points = shapes::sphere(n).points;
  return points;
}

/// What any method based on k nearest neighbours pays: the tree and one query per point, in Morton order, one thread.
double flannSeconds(const RankedCloud& cloud) {
  Stopwatch watch;
  const NeighborSearch search(cloud.points);
  std::vector<Neighbor> found;
  for (int p = 0; p < cloud.size(); ++p) {
    search.nearest(p, neighbor_count, found);
    benchmark::DoNotOptimize(found.data());
  }
  return watch.seconds();
}

RankedCloud ranked(const Points& points) {
  std::vector<PointStatus> status;
  std::vector<int> representative;
  return rankPoints(points, status, representative);
}

/// One build per iteration. With one thread, every build is followed by the search alone (not timed), so that both
/// medians come from the same minutes: `whole_per_flann`.
void runCloud(benchmark::State& state, const CloudCase& c) {
  const Points& points = sphere(c.points);
  Costs costs(c.points);
  for ([[maybe_unused]] auto _ : state) {
    {
      Stopwatch watch;
      const Laplacian laplacian = pointCloudLaplacian(points, {.neighbors = neighbor_count,
                                                               .steps = cloudSteps(c.preset),
                                                               .gluing = c.gluing,
                                                               .delaunay = c.delaunay,
                                                               .threads = c.threads});
      const double seconds = watch.seconds();
      state.SetIterationTime(seconds);
      costs.addBuild(seconds, laplacian.report);
    }
    if (c.threads == 1) costs.addSeconds("flann", flannSeconds(ranked(points)));
  }
  costs.publish(state);
  if (c.threads == 1) {
    state.counters["whole_per_flann"] = costs.medianSeconds("whole") / costs.medianSeconds("flann");
  }
}

void registerCloud(const CloudCase& c) {
  benchmark::RegisterBenchmark(c.name().c_str(), [c](benchmark::State& state) { runCloud(state, c); })
      ->UseManualTime()
      ->Iterations(iterationsFor(c.points))
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

void registerClouds() {
  for (const int points : {10'000, 100'000, 1'000'000}) {
    for (const int threads : {1, 0}) {
      registerCloud({points, Preset::scan, Gluing::star, Delaunay::star, threads});
      for (const Gluing gluing : {Gluing::star, Gluing::vertex_pair}) {
        registerCloud({points, Preset::clean, gluing, Delaunay::star, threads});
#ifdef TUFTED_WITH_GPL
        registerCloud({points, Preset::clean, gluing, Delaunay::cgal, threads});
#endif
      }
    }
  }
}

}  // namespace tufted::bench
