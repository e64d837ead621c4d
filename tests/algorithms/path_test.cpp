// Shortest paths: straight in the plane, CGAL's exact lengths on meshes, great circles on the sphere, and typed errors.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "oracles/geodesics.h"
#include "oracles/planar.h"
#include "shapes/random.h"
#include "shapes/shapes.h"
#include "support/refusal.h"
#include "tufted/tufted.h"

namespace tufted::path_test {
namespace {

/// The sum of the lengths between the points of a path.
double polylineLength(const Points& points) {
  double length = 0;
  for (Eigen::Index i = 0; i + 1 < points.rows(); ++i) length += (points.row(i + 1) - points.row(i)).norm();
  return length;
}

/// Paths beside exact ones.
struct Comparison {
  int pairs = 0, long_ones = 0;  ///< of these, how many are longer by more than half a percent
  double least = 0;              ///< by which part of the exact length any is longer; below 0: shorter
};

/// @param seed by which pairs of vertices are drawn
Comparison compareOn(const shapes::Mesh& mesh, int sources, int targets, std::uint64_t seed) {
  const PathSolver solver(meshLaplacian(mesh.points, mesh.triangles, {.mollify = 0}));
  shapes::Random random(seed);
  Comparison made;
  for (int s = 0; s < sources; ++s) {
    const int face = static_cast<int>(random.uniform() * static_cast<double>(mesh.triangles.rows()));
    const VectorXd exact = *oracles::exactDistances(mesh.points, mesh.triangles, face, {1, 0, 0});
    for (int t = 0; t < targets; ++t) {
      const int to = static_cast<int>(random.uniform() * static_cast<double>(mesh.points.rows()));
      if (!(exact[to] > 0)) continue;
      const SurfacePath path = solver.query(mesh.triangles(face, 0), to);
      const double share = path.length / exact[to] - 1;
      ++made.pairs;
      made.long_ones += share > 0.005 ? 1 : 0;
      made.least = std::min(made.least, share);
    }
  }
  return made;
}

TEST(Path, IsStraightInThePlane) {
  const shapes::Mesh grid = shapes::gridSquare(12), slivers = shapes::slivers(12);  // 1e-10 high
  for (const shapes::Mesh& mesh : {grid, slivers}) {
    const PathSolver solver(meshLaplacian(mesh.points, mesh.triangles, {.mollify = 0}));
    shapes::Random random(101);
    for (int i = 0; i < 40; ++i) {
      const auto draw = [&] { return static_cast<int>(random.uniform() * static_cast<double>(mesh.points.rows())); };
      const int from = draw(), to = draw();
      const SurfacePath path = solver.query(from, to);
      const double exact = (mesh.points.row(to) - mesh.points.row(from)).norm();
      EXPECT_NEAR(path.length, exact, 1e-9) << mesh.name << " from " << from << " to " << to;
      EXPECT_NEAR(polylineLength(path.points), exact, 1e-7) << mesh.name << " from " << from << " to " << to;
      EXPECT_EQ(path.points.row(0), mesh.points.row(from));
      EXPECT_EQ(path.points.row(path.points.rows() - 1), mesh.points.row(to));
    }
  }
}

// Over the rim and along the back a path is locally shortest, too.
TEST(Path, IsStraightAlongARimThatEdgesWereFlippedOver) {
  for (const auto& [stretch, seed] : {std::pair(10.0, 101), {30.0, 102}, {3.0, 103}}) {
    const oracles::PlanarMesh mesh = oracles::obtuseSquare(120, stretch, seed);
    const auto triangles = static_cast<int>(mesh.triangles.rows());
    for (const std::uint64_t order : {1, 2, 3, 4}) {
      const std::vector<int> permutation = shapes::Random(order).permutation(triangles);
      const PathSolver solver(meshLaplacian(mesh.points, mesh.triangles(permutation, Eigen::all), {.mollify = 0}));
      for (int from = 0; from < mesh.points.rows(); from += 20) {
        for (int to = 0; to < mesh.points.rows(); ++to) {
          const double straight = (mesh.points.row(to) - mesh.points.row(from)).norm();
          EXPECT_NEAR(solver.query(from, to).length, straight, 1e-9)
              << "seed " << seed << ", order " << order << ", from " << from << " to " << to;
        }
      }
    }
  }
}

TEST(Path, IsAsLongAsExactOnesOnMeshes) {
  const shapes::Mesh meshes[] = {shapes::cubeMesh(8, shapes::Quality::good), shapes::icosphere(3)};
  for (const shapes::Mesh& mesh : meshes) {
    const Comparison made = compareOn(mesh, 4, 50, 101);
    EXPECT_GE(made.pairs, 180) << mesh.name;
    EXPECT_LE(made.long_ones, made.pairs / 100) << mesh.name;
    EXPECT_GE(made.least, -1e-12) << mesh.name;
  }
}

TEST(Path, RunsAlongGreatCirclesOfClouds) {
  const Points points = shapes::sphere(8000, shapes::Sampling::uniform, 101).points;
  const VectorXd exact = shapes::sphereDistances(points, 0);
  const PathSolver solver(pointCloudLaplacian(points));
  for (int to = 1; to < 8000; to += 400) {
    const SurfacePath path = solver.query(0, to);
    EXPECT_NEAR(path.length, exact[to], 0.005 * exact[to]) << to;
    EXPECT_NEAR(polylineLength(path.points), path.length, 0.001 * path.length) << to;
    const Eigen::Vector3d first = points.row(0), last = points.row(to);
    const double off = (path.points * first.cross(last).normalized()).cwiseAbs().maxCoeff();
    EXPECT_LE(off, 0.08) << to;  // two spacings
    EXPECT_GE(path.points.rowwise().norm().minCoeff(), 0.99) << to;
  }
}

TEST(Path, CrossesTheSpineOfABook) {
  const oracles::Book book = oracles::badBook(3, 20, 1.0, 101);
  const int from = 100;
  const PathSolver solver(meshLaplacian(book.points, book.triangles, {.mollify = 0}));
  const VectorXd exact = oracles::bookDistances(book, from);
  for (int to = 0; to < exact.size(); ++to) EXPECT_NEAR(solver.query(from, to).length, exact[to], 1e-9) << to;
}

TEST(Path, IsAsLongBackwards) {
  const shapes::Mesh strip = shapes::moebius(12);
  const PathSolver solver(meshLaplacian(strip.points, strip.triangles));
  for (int i = 1; i < strip.points.rows(); i += 5) {
    const double there = solver.query(0, i).length;
    EXPECT_NEAR(solver.query(i, 0).length, there, 1e-9 * there) << i;
  }
}

TEST(Path, OfOnePointAndOfCoincidentOnesIsThatPoint) {
  Points points = shapes::sphere(500).points;
  points.row(7) = points.row(3);
  const PathSolver solver(pointCloudLaplacian(points));
  for (const auto& [from, to] : {std::pair(5, 5), std::pair(3, 7)}) {
    const SurfacePath path = solver.query(from, to);
    EXPECT_EQ(path.length, 0);
    ASSERT_EQ(path.points.rows(), 1);
    EXPECT_EQ(path.points.row(0), points.row(from));
  }
}

TEST(Path, IsNoLongerThanDistancesOnAnyShape) {
  for (const shapes::Mesh& mesh : shapes::allMeshes()) {
    const Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles);
    const PathSolver solver(laplacian);
    const auto n = static_cast<int>(mesh.points.rows());
    const int from = n / 2;
    if (n == 0 || laplacian.component[from] < 0) continue;
    const VectorXd distance = DistanceSolver(laplacian).query({from});
    for (int to = 0; to < n; to += std::max(1, n / 7)) {
      if (laplacian.component[to] != laplacian.component[from]) continue;
      const SurfacePath path = solver.query(from, to);
      EXPECT_TRUE(path.points.allFinite()) << mesh.name << " to " << to;
      EXPECT_LE(path.length, 1.02 * distance[to] + 1e-9 * distance.maxCoeff()) << mesh.name << " to " << to;
    }
  }
}

TEST(Path, NamesWhatACallerGotWrongAndStopsWhenTold) {
  using support::refusal;
  const Points ball = shapes::sphere(50).points;
  Points points(100, 3);
  points.topRows(50) = ball;
  points.bottomRows(50) = ball.rowwise() + Eigen::RowVector3d(100, 0, 0);
  const Laplacian laplacian = pointCloudLaplacian(points, {.neighbors = 12});
  const PathSolver solver(laplacian);
  EXPECT_EQ(refusal([&] { solver.query(100, 0); }), "PathSolver::query: from = 100, must lie in [0, 100)");
  EXPECT_EQ(refusal([&] { solver.query(0, -1); }), "PathSolver::query: to = -1, must lie in [0, 100)");
  EXPECT_EQ(refusal([&] { solver.query(0, 99); }),
            "PathSolver::query: no path leads from 0 to 99, must lie on one component");
  Laplacian without = laplacian;
  without.positions.resize(0, 3);
  EXPECT_EQ(refusal([&] { PathSolver{without}; }), "PathSolver: positions has 0 rows, must have 100");
  EXPECT_THROW(PathSolver(laplacian, {.progress = [](std::string_view, double) { return false; }}), Cancelled);
  EXPECT_THROW(solver.query(0, 20, [](std::string_view, double) { return false; }), Cancelled);
}

}  // namespace
}  // namespace tufted::path_test
