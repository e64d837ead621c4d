// Ways through points, straightened within their class: around handles, and loops that contract or do not.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "shapes/shapes.h"
#include "support/refusal.h"
#include "tufted/tufted.h"

namespace tufted::path_through_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int around = 60, across = 30;

/// Index of a vertex of the torus: j = 0 lies outside, j = across / 2 inside.
int at(int i, int j) {
  return (i % around) * across + j % across;
}

/// The torus of radii 1 and 0.4 as a mesh of right triangles.
Laplacian torus() {
  Points points(around * across, 3);
  Triangles triangles(2 * around * across, 3);
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double u = 2 * pi * i / around, v = 2 * pi * j / across, ring = 1 + 0.4 * std::cos(v);
      const int row = at(i, j);
      points.row(row) << ring * std::cos(u), ring * std::sin(u), 0.4 * std::sin(v);
      triangles.row(2 * row) << at(i, j), at(i + 1, j), at(i + 1, j + 1);
      triangles.row(2 * row + 1) << at(i, j), at(i + 1, j + 1), at(i, j + 1);
    }
  return meshLaplacian(points, triangles, {.mollify = 0});
}

/// Length of a regular polygon in a circle, as the circles of the torus are.
double polygon(double radius, int corners) {
  return 2 * corners * radius * std::sin(pi / corners);
}

TEST(PathThrough, GoesAroundAHandleOnTheSideThatThePointsSay) {
  const PathSolver solver(torus());
  const int inside = across / 2;
  const SurfacePath way = solver.through({at(0, inside), at(20, inside), at(40, inside), at(50, inside)}, false);
  EXPECT_NEAR(way.length, polygon(0.6, around) * 50 / 60, 1e-9);
  EXPECT_NEAR(solver.query(at(0, inside), at(50, inside)).length, polygon(0.6, around) * 10 / 60, 1e-9);
  // The points in the middle lie outside, and the way does not keep them.
  const SurfacePath pulled = solver.through({at(0, inside), at(20, 8), at(40, 22), at(50, inside)}, false);
  EXPECT_NEAR(pulled.length, way.length, 1e-9);
  EXPECT_LT(pulled.points.leftCols(2).rowwise().norm().maxCoeff(), 0.6 + 1e-9);
}

TEST(PathThrough, LoopsAreTheShortestOfTheirClass) {
  const PathSolver solver(torus());
  for (const std::vector<int>& points : std::vector<std::vector<int>>{
           {at(0, 0), at(20, 0), at(40, 0)}, {at(0, 3), at(20, 7), at(40, 11)}, {at(7, 0), at(25, 9), at(45, 5)}}) {
    const SurfacePath loop = solver.through(points, true);
    EXPECT_NEAR(loop.length, polygon(0.6, around), 1e-9);
    EXPECT_GT((loop.points.row(0) - loop.points.row(loop.points.rows() - 1)).norm(), 1e-3);
  }
  const SurfacePath meridian = solver.through({at(0, 0), at(3, 10), at(1, 20)}, true);
  EXPECT_NEAR(meridian.length, 2 * pi * 0.4, 0.02 * 2 * pi * 0.4);
}

TEST(PathThrough, LoopsThatNothingHoldsContract) {
  const PathSolver solver(torus());
  for (const std::vector<int>& points :
       std::vector<std::vector<int>>{{at(0, 3), at(3, 7), at(6, 5)}, {at(0, 3), at(3, 7)}, {5, 5}}) {
    const SurfacePath loop = solver.through(points, true);
    EXPECT_EQ(loop.length, 0);
    EXPECT_EQ(loop.points.rows(), 1);
  }
}

/// A piece that is laid through other triangles is mirrored, and may then pass the hole on the other side.
TEST(PathThrough, StaysInItsClassOnASymmetricCloud) {
  const Laplacian cloud = pointCloudLaplacian(torus().positions);
  const std::vector<int> points = {at(0, 3), at(20, 7), at(40, 11)};
  EXPECT_NEAR(PathSolver(cloud).through(points, true).length, polygon(0.6, around), 1e-9);
}

TEST(PathThrough, NamesWhatACallerGotWrongAndStopsWhenTold) {
  using support::refusal;
  const PathSolver solver(torus());
  EXPECT_EQ(refusal([&] { solver.through({3}, true); }),
            "PathSolver::through: points has 1 indices, must have at least 2");
  EXPECT_EQ(refusal([&] {
              solver.through({3, 1800}, false);
            }),
            "PathSolver::through: points = 1800, must lie in [0, 1800)");
  EXPECT_THROW(solver.through({0, 900}, true, [](std::string_view, double) { return false; }), Cancelled);
}

}  // namespace
}  // namespace tufted::path_through_test
