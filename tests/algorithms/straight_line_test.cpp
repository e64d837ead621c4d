// No way over a surface is shorter than the straight line.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "shapes/shapes.h"
#include "tufted/tufted.h"

namespace tufted::straight_line_test {
namespace {

constexpr double rounding = 1e-12;

/// Surfaces whose triangles flips have led over edges and rims.
std::vector<Laplacian> folded() {
  std::vector<Laplacian> found;
  const std::uint64_t seed = 101;
  const Points clouds[] = {shapes::cubeSurface(1000, seed).points,
                           shapes::torus(1000, shapes::Sampling::uniform, seed).points,
                           shapes::withNoise(shapes::torus(1000, shapes::Sampling::uniform, seed), 0.01).points};
  for (const Points& points : clouds) {
    found.push_back(pointCloudLaplacian(points));
    found.push_back(pointCloudLaplacian(points, cloudOptions(Preset::clean)));
  }
  const shapes::Mesh meshes[] = {shapes::cubeMesh(8, shapes::Quality::bad), shapes::prismMesh(8, shapes::Quality::bad),
                                 shapes::fins(12), shapes::moebius(12)};
  for (const shapes::Mesh& mesh : meshes) found.push_back(meshLaplacian(mesh.points, mesh.triangles));
  return found;
}

TEST(StraightLine, IsNotLongerThanDistances) {
  for (const Laplacian& laplacian : folded()) {
    const auto n = static_cast<int>(laplacian.L.rows());
    for (const int split : {0, 1, 2}) {
      const DistanceSolver solver(laplacian, {.split = split});
      for (int source = 0; source < n; source += n / 20) {
        const VectorXd distance = solver.query({source}),
                       straight = (laplacian.positions.rowwise() - laplacian.positions.row(source)).rowwise().norm();
        for (int i = 0; i < n; ++i) ASSERT_GE(distance[i], (1 - rounding) * straight[i]) << source << " to " << i;
      }
    }
  }
}

TEST(StraightLine, IsNotLongerThanDistancesFromSeveralSources) {
  for (const Laplacian& laplacian : folded()) {
    const auto n = static_cast<int>(laplacian.L.rows());
    std::vector<int> sources;
    for (int source = 3; source < n; source += n / 20) sources.push_back(source);
    VectorXd straight = VectorXd::Constant(n, HUGE_VAL);
    for (const int source : sources)
      straight = straight.cwiseMin((laplacian.positions.rowwise() - laplacian.positions.row(source)).rowwise().norm());
    const VectorXd distance = DistanceSolver(laplacian).query(sources);
    for (int i = 0; i < n; ++i) ASSERT_GE(distance[i], (1 - rounding) * straight[i]) << i;
    const NearbyPoints near = pointsWithin(laplacian, sources, 0.3);
    for (std::size_t i = 0; i < near.points.size(); ++i)
      ASSERT_GE(near.distances[i], (1 - rounding) * straight[near.points[i]]) << near.points[i];
  }
}

TEST(StraightLine, IsNotLongerThanPaths) {
  for (const Laplacian& laplacian : folded()) {
    const auto n = static_cast<int>(laplacian.L.rows());
    const DistanceSolver solver(laplacian, {.split = 0});
    const PathSolver paths(laplacian);
    for (int from = 0; from < n; from += n / 5) {
      const VectorXd distance = solver.query({from}),
                     straight = (laplacian.positions.rowwise() - laplacian.positions.row(from)).rowwise().norm();
      for (int to = from % 7; to < n; to += n / 20)
        if (std::isfinite(distance[to])) {
          ASSERT_GE(paths.query(from, to).length, (1 - rounding) * straight[to]) << from << " to " << to;
        }
    }
  }
}

}  // namespace
}  // namespace tufted::straight_line_test
