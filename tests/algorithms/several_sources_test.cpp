// Distances from several sources by marching: the least of those from each, and which source that is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include "oracles/planar.h"
#include "shapes/random.h"
#include "shapes/shapes.h"
#include "tufted/tufted.h"

namespace tufted::several_sources_test {
namespace {

/// Different points.
std::vector<int> randomSources(int points, int count, std::uint64_t seed) {
  shapes::Random random(seed);
  std::vector<int> all(static_cast<std::size_t>(points));
  std::iota(all.begin(), all.end(), 0);
  for (int i = 0; i < count; ++i) std::swap(all[i], all[i + static_cast<int>(random.uniform() * (points - i))]);
  all.resize(static_cast<std::size_t>(count));
  return all;
}

std::vector<int> firstPoints(int count) {
  std::vector<int> sources(static_cast<std::size_t>(count));
  std::iota(sources.begin(), sources.end(), 0);
  return sources;
}

/// Expects distances from all sources at once to be the least of those from each by itself up to `error`, a part, and
/// the nearest sources to be those.
void expectLeast(const Laplacian& laplacian, const std::vector<int>& sources, int split, double error) {
  SCOPED_TRACE(std::to_string(sources.size()) + " sources, split " + std::to_string(split));
  const DistanceSolver solver(laplacian, {.split = split});
  const Eigen::Index n = laplacian.L.rows();
  Eigen::MatrixXd each(n, std::ssize(sources));
  std::vector<SurfacePoint> places;
  for (std::size_t s = 0; s < sources.size(); ++s) {
    each.col(static_cast<Eigen::Index>(s)) = solver.query({sources[s]});
    places.push_back(SurfacePoint::vertex(sources[s]));
  }
  const NearestSources found = solver.nearest(places);
  const VectorXd least = each.rowwise().minCoeff();
  for (Eigen::Index i = 0; i < n; ++i) {
    if (!std::isfinite(least[i])) {
      EXPECT_EQ(found.distance[i], least[i]) << i;
      continue;
    }
    EXPECT_NEAR(found.distance[i], least[i], error * least[i]) << "point " << i;
    EXPECT_LE(each(i, found.source[i]), (1 + error) * least[i]) << "point " << i;
  }
  // Within a radius the same holds.
  std::vector<double> sorted(least.data(), least.data() + n);
  std::nth_element(sorted.begin(), sorted.begin() + n / 2, sorted.end());
  const double radius = sorted[static_cast<std::size_t>(n) / 2];
  if (radius > 0 && std::isfinite(radius)) {
    const NearbyPoints near = pointsWithin(laplacian, sources, radius, split);
    EXPECT_NEAR(static_cast<double>(near.points.size()), static_cast<double>((least.array() <= radius).count()),
                error > 1e-6 ? 2 : 1);
    for (std::size_t i = 0; i < near.points.size(); ++i)
      EXPECT_NEAR(near.distances[i], least[near.points[i]], error * least[near.points[i]]) << near.points[i];
  }
}

TEST(SeveralSources, AreAsNearAsTheNearestOfThemOnAFlatGrid) {
  const shapes::Mesh grid = shapes::gridSquare(30);
  const Laplacian laplacian = meshLaplacian(grid.points, grid.triangles);
  const auto n = static_cast<int>(grid.points.rows());
  for (const int split : {0, 1, 2})
    for (const int count : {2, 3, 10, 30, 100}) expectLeast(laplacian, randomSources(n, count, 101), split, 1e-9);
}

TEST(SeveralSources, AreAsNearAsTheNearestOfThemOnFlatMeshesWithObtuseAngles) {
  for (const std::uint64_t seed : {101, 102}) {
    Points points = shapes::square(900, shapes::Sampling::uniform, shapes::Rim::none, seed).points;
    points.col(2).setZero();
    const Laplacian laplacian = meshLaplacian(points, oracles::stretchedDelaunay(points, 1));
    for (const int split : {0, 1, 2})
      for (const int count : {3, 30, 100}) expectLeast(laplacian, randomSources(900, count, seed), split, 1e-9);
  }
}

TEST(SeveralSources, MayLieSideBySide) {
  const shapes::Mesh grid = shapes::gridSquare(24);
  const Laplacian laplacian = meshLaplacian(grid.points, grid.triangles);
  for (const int split : {0, 1, 2})
    for (const int count : {2, 25, 100}) expectLeast(laplacian, firstPoints(count), split, 1e-9);
}

TEST(SeveralSources, AreAsNearAsTheNearestOfThemOnCurvedMeshesAndClouds) {
  const shapes::Mesh ball = shapes::icosphere(3), cube = shapes::cubeMesh(8, shapes::Quality::bad);
  const Laplacian laplacians[] = {meshLaplacian(ball.points, ball.triangles),
                                  meshLaplacian(cube.points, cube.triangles),
                                  pointCloudLaplacian(shapes::torus(1000, shapes::Sampling::uniform, 101).points),
                                  pointCloudLaplacian(shapes::cubeSurface(1000, 101).points),
                                  pointCloudLaplacian(shapes::withNoise(shapes::sphere(1000), 0.01).points)};
  for (const Laplacian& laplacian : laplacians) {
    const auto n = static_cast<int>(laplacian.L.rows());
    for (const int count : {3, 10, 100}) expectLeast(laplacian, randomSources(n, std::min(count, n / 4), 101), 1, 1e-3);
    expectLeast(laplacian, {0, 5, 70}, 2, 1e-3);
  }
}

TEST(SeveralSources, ReachPointsFewTimes) {
  const shapes::Mesh grid = shapes::gridSquare(100);
  const DistanceSolver solver(meshLaplacian(grid.points, grid.triangles));
  const auto n = static_cast<int>(grid.points.rows());
  DistanceReport one, several;
  solver.query({n / 2}, &one);
  for (const int count : {3, 30, 100}) {
    solver.query(randomSources(n, count, 101), &several);
    EXPECT_LE(several.visits, 3 * one.visits) << count;
  }
  // Side by side each marches at most 16 half edges beside the strip where it is the nearest.
  solver.query(firstPoints(100), &several);
  EXPECT_LE(several.visits, 20 * one.visits);
}

TEST(SeveralSources, HaveAColumnEachInAMatrix) {
  const shapes::Mesh grid = shapes::gridSquare(12);
  const Laplacian laplacian = meshLaplacian(grid.points, grid.triangles);
  const std::vector<SurfacePoint> places = {SurfacePoint::vertex(3),
                                            SurfacePoint::inFace(grid.points, grid.triangles, 40, {0.2, 0.3, 0.5}),
                                            SurfacePoint::vertex(77), SurfacePoint::vertex(3)};
  for (const DistanceMethod method : {DistanceMethod::marching, DistanceMethod::heat}) {
    for (const int threads : {1, 3}) {
      const DistanceSolver solver(laplacian, {.method = method, .solver = {.threads = threads}});
      DistanceReport report, one;
      const Eigen::MatrixXd found = solver.matrix(places, false, &report);
      std::int64_t visits = 0;
      for (std::size_t s = 0; s < places.size(); ++s) {
        EXPECT_EQ(found.col(static_cast<Eigen::Index>(s)), solver.queryAt({places[s]}, &one)) << s;
        visits += one.visits;
      }
      EXPECT_EQ(report.visits, visits);
      EXPECT_THROW(solver.matrix(places, true), InvalidInput);
      int calls = 0;
      // Two calls are certain: that before the work and that after it.
      const Progress stop = [&](std::string_view, double) { return ++calls < 2; };
      EXPECT_THROW(solver.matrix(places, false, nullptr, stop), Cancelled);
    }
  }
}

TEST(SeveralSources, AreAsFarThereAsBackOnRequest) {
  const std::vector<int> sources = {3, 77, 500};
  std::vector<SurfacePoint> places;
  for (const int source : sources) places.push_back(SurfacePoint::vertex(source));
  const DistanceSolver solver(pointCloudLaplacian(shapes::sphere(1000).points));
  const Eigen::MatrixXd plain = solver.matrix(places), even = solver.matrix(places, true);
  const Eigen::Matrix3d there = plain(sources, Eigen::all);
  EXPECT_GT((there - there.transpose()).norm(), 0);
  EXPECT_EQ(even(sources, Eigen::all), (there + there.transpose()) / 2);
  EXPECT_EQ((even.array() != plain.array()).count(), 6);
}

TEST(SeveralSources, CountOnceWhereTheyAreTheSame) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::sphere(1000).points);
  const DistanceSolver solver(laplacian);
  DistanceReport once, thrice;
  const VectorXd distance = solver.query({7, 90}, &once);
  EXPECT_EQ(solver.query({7, 90, 7, 7, 90}, &thrice), distance);
  EXPECT_EQ(thrice.visits, once.visits);
}

}  // namespace
}  // namespace tufted::several_sources_test
