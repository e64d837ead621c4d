// Surfaces as narrow as their samples are far apart: no point may get more than there is.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "shapes/random.h"
#include "shapes/shapes.h"
#include "tufted/tufted.h"

namespace tufted::thin_surfaces_test {
namespace {

// Constants of the library were chosen on seeds 1 to 9.
constexpr std::uint64_t first_seed = 101, last_seed = 105;

Points turned(const Points& points) {
  const Eigen::AngleAxisd turn(0.7, Eigen::Vector3d(1, 2, 3).normalized());
  return points * turn.toRotationMatrix().transpose();
}

/// Random points of the rectangle 1 x width.
Points ribbon(int n, double width, std::uint64_t seed) {
  Points points = shapes::square(n, shapes::Sampling::uniform, shapes::Rim::none, seed).points;
  points.col(1) *= width;
  return points;
}

class Ribbon : public testing::TestWithParam<double> {};

TEST_P(Ribbon, HasTheAreaOfItsCoverAndOfItsSurfaceWherePointsFillIt) {
  const double width = GetParam();
  struct Size {
    int points;
    std::uint64_t seeds;
  };
  for (const auto [n, seeds] : {Size{300, 10}, Size{1000, 5}, Size{3000, 3}, Size{10000, 1}}) {
    const bool is_filled = width >= std::sqrt(width / n);
    for (std::uint64_t seed = first_seed; seed < first_seed + seeds; ++seed) {
      const Points points = ribbon(n, width, seed);
      for (const Points& placed : {points, turned(points)}) {
        const Report report = pointCloudLaplacian(placed, {.keep_cover = false}).report;
        EXPECT_NEAR(report.area, report.cover_area, 0.25 * report.cover_area) << n << " points, seed " << seed;
        if (!is_filled) continue;
        EXPECT_NEAR(report.area, width, 0.25 * width) << n << " points, seed " << seed;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Widths, Ribbon, testing::Values(1e-1, 1e-2, 1e-3, 1e-4));

TEST(Line, HasAtMostFourTimesTheAreaOfItsCover) {
  for (const int n : {5, 10, 30, 31, 40, 300}) {
    for (const double scatter : {0.0, 1e-12, 1e-6}) {
      for (std::uint64_t seed = first_seed; seed <= last_seed; ++seed) {
        shapes::Random random(seed);
        const auto vector = [&] { return Eigen::RowVector3d(random.uniform(), random.uniform(), random.uniform()); };
        for (const double length : {1e-3, 1.0, 1e6}) {
          const Eigen::RowVector3d line = length * vector().normalized();
          Points points(n, 3);
          for (int i = 0; i < n; ++i) points.row(i) = random.uniform() * line + scatter * length * vector();
          const Report report = pointCloudLaplacian(points).report;
          EXPECT_LE(report.area, 4 * report.cover_area)
              << n << " points, scatter " << scatter << ", length " << length << ", seed " << seed;
        }
      }
    }
  }
}

/// Rows of points around a tube, each turned by half a step: triangles with equal sides where the tube is straight.
/// @param bend radius of the circle that its middle line follows
Points tube(int around, int rows, double bend) {
  Points points(around * rows, 3);
  const double step = 2 * std::numbers::pi / around, between = std::sqrt(0.75) * 2 * std::sin(step / 2);
  for (int i = 0; i < points.rows(); ++i) {
    const int row = i / around;
    const double turn = step * (i % around + row % 2 / 2.), along = row * between / bend;
    const double x = bend + std::cos(turn);
    points.row(i) << x * std::cos(along), x * std::sin(along), std::sin(turn);
  }
  return points;
}

TEST(Tube, OfSevenPointsAroundAndMoreHasItsAreaThoughNeighbourhoodsReachAround) {
  constexpr int rows = 60, rim = 12;  // rows near the ends, which may be closed
  for (int around = 7; around <= 16; ++around) {
    for (const double bend : {1e4, 60.}) {
      const double side = 2 * std::sin(std::numbers::pi / around);
      const Laplacian laplacian = pointCloudLaplacian(turned(tube(around, rows, bend)));
      const Eigen::VectorXd inner = laplacian.M.segment(rim * around, (rows - 2 * rim) * around);
      EXPECT_NEAR(inner.mean(), std::sqrt(0.75) * side * side, 0.05 * inner.mean())
          << around << " around, bend " << bend;
      EXPECT_EQ(laplacian.report.components, 1) << around;
    }
  }
}

}  // namespace
}  // namespace tufted::thin_surfaces_test
