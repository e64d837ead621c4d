#include "tufted/polygons.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "oracles/oracles.h"
#include "shapes/shapes.h"
#include "support/compare.h"
#include "tufted/tufted.h"

namespace tufted::polygons_test {
namespace {

Points planar(const std::vector<std::array<double, 2>>& corners) {
  Points points(corners.size(), 3);
  for (std::size_t i = 0; i < corners.size(); ++i) points.row(i) << corners[i][0], corners[i][1], 1e6;
  return points;
}

std::vector<int> upTo(int n) {
  std::vector<int> all(n);
  for (int i = 0; i < n; ++i) all[i] = i;
  return all;
}

TEST(EarClipping, CoversAConcavePolygonExactlyOnce) {
  const Points comb =
      planar({{0, 0}, {7, 0}, {7, 3}, {6, 3}, {6, 1}, {4, 1}, {4, 3}, {3, 3}, {3, 1}, {1, 1}, {1, 3}, {0, 3}});
  for (const bool reversed : {false, true}) {
    std::vector<int> polygon = upTo(12);
    if (reversed) std::reverse(polygon.begin(), polygon.end());
    const Triangles triangles = triangulate(comb, {polygon});
    ASSERT_EQ(triangles.rows(), 10);
    EXPECT_NEAR(oracles::surfaceArea(comb, triangles), 13, 1e-9);  // more if triangles overlapped
    for (int t = 0; t < 10; ++t) {
      const Eigen::Vector3d a = comb.row(triangles(t, 0)), b = comb.row(triangles(t, 1)), c = comb.row(triangles(t, 2));
      EXPECT_EQ((b - a).cross(c - a).z() > 0, !reversed);
    }
  }
}

TEST(EarClipping, AlwaysGivesTwoLessThanTheCorners) {
  const Points crossing = planar({{0, 0}, {1, 1}, {1, 0}, {0, 1}});
  EXPECT_EQ(triangulate(crossing, {upTo(4)}).rows(), 2);
  EXPECT_EQ(triangulate(planar({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}}), {upTo(5)}).rows(), 3);
  EXPECT_EQ(triangulate(Points::Zero(6, 3), {upTo(6)}).rows(), 4);
  EXPECT_EQ(triangulate(Points::Constant(6, 3, NAN), {upTo(6)}).rows(), 4);
  EXPECT_EQ(triangulate(crossing, {{}, {0}, {0, 1}, {0, 1, 2}}).rows(), 1);
}

TEST(EarClipping, OfThousandsOfCornersEnds) {
  Points circle(5000, 3);
  for (int i = 0; i < 5000; ++i) circle.row(i) << std::cos(2 * M_PI * i / 5000), std::sin(2 * M_PI * i / 5000), 0;
  const Triangles triangles = triangulate(circle, {upTo(5000)});
  EXPECT_EQ(triangles.rows(), 4998);
  EXPECT_NEAR(oracles::surfaceArea(circle, triangles), M_PI, 1e-5);
}

TEST(EarClipping, OfFlatFacesLeavesNoTraceInTheLaplacian) {
  const shapes::Mesh quads = shapes::cubeQuads(6);
  const Laplacian a = meshLaplacian(quads.points, quads.triangles);  // the fans
  const Laplacian b = meshLaplacian(quads.points, triangulate(quads.points, quads.polygons));
  EXPECT_LE(support::largestDifference(a.L, b.L), 1e-9);
}

TEST(EarClipping, NamesAnIndexOutOfRange) {
  EXPECT_THROW(triangulate(Points::Zero(3, 3), {{0, 1, 3}}), InvalidInput);
  EXPECT_THROW(triangulate(Points::Zero(3, 3), {{0, 1, -1}}), InvalidInput);
}

}  // namespace
}  // namespace tufted::polygons_test
