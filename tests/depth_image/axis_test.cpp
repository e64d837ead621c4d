// The axis of a camera, along which the inverse of the depth is linear on planes.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "depth_image/image.h"
#include "shapes/random.h"
#include "tufted/denoise.h"

namespace tufted::axis_test {
namespace {

using namespace image_tests;

Eigen::RowVector3d axisOf(const Points& points, const Eigen::Vector3d& origin = Eigen::Vector3d::Zero()) {
  ScanStructure structure = imageStructure(width, height);
  structure.origin = origin;
  return Image(points, structure).grid().axis;
}

/// A rough surface with a quarter of its pixels missing.
double roughDepth(int column, int row) {
  return column < 20 && row < 35 ? std::nan("") : 2 + std::sin(0.7 * column) + 0.3 * std::cos(2.0 * row);
}

TEST(Axis, IsThatOfThePinholeWhateverItSees) {
  const Points points = imageOf(roughDepth);
  EXPECT_LT((axisOf(points) - Eigen::RowVector3d::UnitZ()).norm(), 1e-9);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::RowVector3d moved(10, -20, 3);
  const Points elsewhere = (points * turn.transpose()).rowwise() + moved;
  EXPECT_LT((axisOf(elsewhere, moved.transpose()).transpose() - turn.col(2)).norm(), 1e-9);
}

TEST(Axis, IsNoneWhereThereIsNoPinhole) {
  EXPECT_TRUE(axisOf(imageOf(roughDepth), {0.5, 0, 0}).isZero(0)) << "the origin is not that of the rays";
  const auto few = [](int column, int row) { return column < 7 && row < 12 ? 1.0 : std::nan(""); };
  EXPECT_TRUE(axisOf(imageOf(few)).isZero(0)) << "84 points in seven columns";
  Points fisheye(width * height, 3);  // angles in place of tangents
  for (int i = 0; i < fisheye.rows(); ++i) {
    const double u = (i % width - width / 2) / 25.0, v = (i / width - height / 2) / 25.0;
    fisheye.row(i) << std::sin(u), std::cos(u) * std::sin(v), std::cos(u) * std::cos(v);
  }
  EXPECT_TRUE(axisOf(fisheye).isZero(0));
}

TEST(Axis, IsFoundWhereMissingPointsAreStoredAsZeroAndColumnsAreLeftOut) {
  const auto depth = [](int column, int row) {
    return column > 30 && column < 40 ? std::nan("") : 2 + std::sin(0.7 * column) + 0.3 * std::cos(2.0 * row);
  };
  Points points = imageOf(depth);
  points.row(25 * width + 20).setZero();
  EXPECT_LT((axisOf(points) - Eigen::RowVector3d::UnitZ()).norm(), 1e-9);
  const Image image(points);
  int missing = 0;
  for (const std::int64_t pixel : image.grid().pixel) missing += pixel < 0 ? 1 : 0;
  EXPECT_EQ(missing, 1);
}

// A wall through an image with a bar in front of it, so that all windows of the wall end at a jump. Inverse ranges of a
// plane bend over the image, inverse depths do not: fits of planes to parts of windows then have no bias.
TEST(Axis, LetsAWallNextToJumpsStayWhereItIs) {
  constexpr int columns = 320, rows = 240;
  constexpr double focal = 260, wall = 3, noise = 1e-3;
  shapes::Random random(5);
  Points points(columns * rows, 3);
  for (int i = 0; i < points.rows(); ++i) {
    const int column = i % columns, row = i / columns;
    const double depth = column / 30 % 2 == 0 ? wall : 1;
    const Eigen::RowVector3d ray((column - columns / 2) / focal, (row - rows / 2) / focal, 1);
    points.row(i) = ray / (1 / depth + noise * random.normal());
  }
  const ScanStructure structure = imageStructure(columns, rows);
  const Points moved = denoise(points, {.structure = &structure}).positions;
  double sum = 0, count = 0;
  for (int i = 0; i < points.rows(); ++i) {
    if (moved(i, 2) < 2) continue;
    sum += moved(i, 2) - wall;
    ++count;
  }
  EXPECT_NEAR(sum / count, 0, 0.03 * noise * wall * wall);
}

}  // namespace
}  // namespace tufted::axis_test
