// Laplacian::positions: where lengths are measured.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "shapes/shapes.h"
#include "tufted/tufted.h"

namespace tufted::positions_test {
namespace {

bool sameBits(const Points& a, const Points& b) {
  return a.rows() == b.rows() && std::memcmp(a.data(), b.data(), static_cast<std::size_t>(a.size()) * 8) == 0;
}

/// The share of the cover's edges that are as long as the segment between their ends.
double straightEdges(const Laplacian& laplacian, const Points& positions) {
  const IntrinsicTriangulation& cover = laplacian.cover();
  int straight = 0, edges = 0;
  for (std::size_t f = 0; f < cover.faces.size(); ++f) {
    for (int i = 0; i < 3; ++i, ++edges) {
      const double chord = (positions.row(cover.faces[f][i]) - positions.row(cover.faces[f][(i + 1) % 3])).norm();
      straight += std::abs(cover.length[3 * f + i] - chord) <= 1e-9 * chord ? 1 : 0;
    }
  }
  return static_cast<double>(straight) / edges;
}

TEST(Positions, AreTheCallersBitForBitWhereNothingMoves) {
  shapes::Cloud cloud = shapes::sphere(2000);
  cloud.points.row(3) << -0.0, 1.5, std::nan("");
  cloud.points.row(5) << 1e6, 0, 0;
  const Laplacian laplacian = pointCloudLaplacian(cloud.points, cloudOptions(Preset::clean));
  EXPECT_TRUE(sameBits(laplacian.positions, cloud.points));
  const shapes::Mesh ball = shapes::icosphere(2);
  EXPECT_TRUE(sameBits(meshLaplacian(ball.points, ball.triangles).positions, ball.points));
}

TEST(Positions, AreWhatLengthsAreMeasuredBetween) {
  const Points points = shapes::withNoise(shapes::sphere(4000), 0.01).points;
  const Laplacian laplacian = pointCloudLaplacian(points);
  EXPECT_GT(straightEdges(laplacian, laplacian.positions), 0.9);  // the others come from flips
  EXPECT_LT(straightEdges(laplacian, points), 0.1);
  int moved = 0;
  for (int i = 0; i < 4000; ++i) moved += laplacian.positions.row(i) != points.row(i) ? 1 : 0;
  EXPECT_EQ(moved, laplacian.report.denoised);
}

TEST(Positions, LieNearerToTheSurfaceThanNoisyPoints) {
  const Points points = shapes::withNoise(shapes::sphere(8000), 0.01).points;
  const Points positions = pointCloudLaplacian(points).positions;
  const auto error = [](const Points& some) { return std::sqrt((some.rowwise().norm().array() - 1).square().mean()); };
  EXPECT_LT(error(positions), 0.5 * error(points));
}

TEST(Positions, OfCoincidentPointsAreEqual) {
  Points points = shapes::withNoise(shapes::sphere(1000), 0.02).points;
  points.row(700) = points.row(20);
  const Laplacian laplacian = pointCloudLaplacian(points);
  ASSERT_EQ(laplacian.status[700], PointStatus::coincident);
  EXPECT_EQ(laplacian.positions.row(700), laplacian.positions.row(20));
  EXPECT_NE(laplacian.positions.row(700), points.row(700));
}

TEST(Positions, ScaleWithThePoints) {
  const Points points = shapes::withNoise(shapes::sphere(1000), 0.02).points;
  const Points positions = pointCloudLaplacian(points).positions;
  for (const double scale : {std::ldexp(1.0, 400), std::ldexp(1.0, -400)}) {
    const Points scaled = scale * points;
    EXPECT_TRUE(sameBits(pointCloudLaplacian(scaled).positions, scale * positions)) << scale;
  }
}

TEST(Positions, OfTheWrongNumberAreRefused) {
  const shapes::Mesh ball = shapes::icosphere(2);
  Laplacian laplacian = meshLaplacian(ball.points, ball.triangles);
  laplacian.positions.row(7).setConstant(std::numeric_limits<double>::infinity());
  EXPECT_EQ(validate(laplacian).faults, (std::vector<std::string>{"position: that of point 7 is not finite"}));
  laplacian.positions.conservativeResize(5, Eigen::NoChange);
  EXPECT_FALSE(validate(laplacian).ok());
  EXPECT_THROW(DistanceSolver{laplacian}, InvalidInput);
  laplacian.positions.resize(0, 3);
  EXPECT_TRUE(validate(laplacian).ok());
}

}  // namespace
}  // namespace tufted::positions_test
