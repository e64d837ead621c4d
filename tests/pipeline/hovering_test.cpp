// The warning of points that hover over a surface, such as vegetation in an airborne scan.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "shapes/random.h"
#include "shapes/shapes.h"
#include "tufted/describe.h"

namespace tufted::hovering_test {
namespace {

constexpr double side = 100;  // of a terrain with a point per square unit

double heightAt(double x, double y) {
  return 5 * std::sin(x / 20) + 3 * std::cos(y / 15);
}

/// A terrain seen from above: noisy ground, a flat roof, and crowns of trees of 300 points each.
/// @param share of the points in crowns
/// @param noise standard deviation of heights
Points terrain(double share, double noise, std::uint64_t seed) {
  constexpr int n = 10000, crown = 300;
  shapes::Random random(seed);
  const int ground = static_cast<int>(n * (1 - share));
  Points points(n, 3);
  for (int i = 0; i < ground; ++i) {
    const double x = random.uniform(0, side), y = random.uniform(0, side);
    const bool is_roof = std::abs(x - 40) < 10 && std::abs(y - 60) < 6;
    points.row(i) << x, y, (is_roof ? 25 : heightAt(x, y)) + noise * random.normal();
  }
  Eigen::RowVector3d middle = Eigen::RowVector3d::Zero();
  for (int i = ground; i < n; ++i) {
    if ((i - ground) % crown == 0) {
      const double x = random.uniform(10, side - 10), y = random.uniform(10, side - 10);
      middle << x, y, heightAt(x, y) + 15;
    }
    do points.row(i) << random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1);
    while (points.row(i).norm() > 1);
    points.row(i) = middle + 8 * points.row(i);
  }
  return points;
}

TEST(Hovering, IsSaidOfTreesAboveTheGround) {
  for (const std::uint64_t seed : {101, 102, 103}) {
    EXPECT_NE(hoveringWarning(terrain(0.05, 0.1, seed)).find("--where"), std::string::npos) << seed;
    EXPECT_NE(hoveringWarning(terrain(0.2, 0.1, seed)).find("--where"), std::string::npos) << seed;
  }
}

TEST(Hovering, DoesNotDependOnOrderUnitOrPlaceOfPoints) {
  const Points points = terrain(0.05, 0.1, 104), moved = (4 * points).rowwise() + Eigen::RowVector3d(5e5, 5e6, 0);
  const std::string expected = hoveringWarning(points);
  EXPECT_NE(expected, "");
  EXPECT_EQ(hoveringWarning(moved), expected);
  EXPECT_EQ(hoveringWarning(points.colwise().reverse()), expected);
}

TEST(Hovering, IsNotSaidOfNoiseOrBuildings) {
  for (const double noise : {0., 0.1, 0.5, 0.8, 1., 1.2, 1.5, 2., 4.})
    EXPECT_EQ(hoveringWarning(terrain(0, noise, 105)), "") << noise;
}

TEST(Hovering, IsNotSaidOfBodiesSeenFromAllSides) {
  shapes::Random random(106);
  for (const double noise : {0., 0.01, 0.05, 0.1}) {
    Points points = shapes::sphere(5000, shapes::Sampling::uniform, 106).points;
    for (double& coordinate : points.reshaped()) coordinate += noise * random.normal();
    EXPECT_EQ(hoveringWarning(points), "") << noise;
  }
}

TEST(Hovering, OfOddDataIsNotSaid) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(hoveringWarning(Points(0, 3)), "");
  EXPECT_EQ(hoveringWarning(Points::Constant(2000, 3, nan)), "");
  EXPECT_EQ(hoveringWarning(Points::Constant(2000, 3, 7)), "");
  EXPECT_EQ(hoveringWarning(terrain(0.05, 0.1, 107).topRows(900)), "");
  Points some_missing = terrain(0.05, 0.1, 108);
  for (int i = 0; i < some_missing.rows(); i += 7) some_missing.row(i).setConstant(nan);
  EXPECT_NE(hoveringWarning(some_missing), "");
}

}  // namespace
}  // namespace tufted::hovering_test
