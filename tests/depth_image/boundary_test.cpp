// Where surfaces end in depth images, and which clouds are depth images.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "depth_image/image.h"
#include "shapes/random.h"
#include "shapes/shapes.h"
#include "tufted/laplacian.h"

namespace tufted::boundary_test {
namespace {

using namespace image_tests;

TEST(ImageBoundary, NamesRimsAndJumps) {
  // A wall with a hole, and a smaller one in front of its right half.
  const Points points = imageOf([](int column, int row) {
    if (column > 8 && column < 14 && row > 20 && row < 26) return std::nan("");
    return column >= 40 && row >= 10 && row < 40 ? 0.7 : planeDepth(column, row, 0.1, 0.2);
  });
  const Laplacian laplacian = imageLaplacian(points);
  for (int i = 0; i < points.rows(); ++i) {
    const int column = i % width, row = i / width;
    if (std::isnan(points(i, 0))) continue;
    const bool in_front = column >= 40 && row >= 10 && row < 40;
    const bool beside_front = column >= 39 && row >= 9 && row < 41;
    const bool on_edge_of_front = in_front && (column == 40 || row == 10 || row == 39);
    const bool on_image_rim = column == 0 || row == 0 || column == width - 1 || row == height - 1;
    const bool beside_hole = column > 7 && column < 15 && row > 19 && row < 27;
    const Boundary boundary = laplacian.boundary[i];
    if (on_image_rim && !beside_front) {
      EXPECT_EQ(boundary, Boundary::rim) << column << ' ' << row;
    } else if (on_image_rim) {
      EXPECT_NE(boundary, Boundary::none) << column << ' ' << row;
    } else if (beside_hole && !(column == 8 && row == 20)) {
      EXPECT_TRUE(boundary == Boundary::rim || boundary == Boundary::none) << column << ' ' << row;
    } else if (on_edge_of_front || (beside_front && !in_front)) {
      EXPECT_TRUE(boundary == Boundary::jump || !in_front) << column << ' ' << row;
    } else {
      EXPECT_EQ(boundary, Boundary::none) << column << ' ' << row;
    }
  }
  EXPECT_EQ(laplacian.report.components, 2);
}

TEST(ImageBoundary, OfATearBetweenTwoLipsIsNotBridged) {
  // A slanted sheet torn from row 15 down between two columns, each lip bent further back or forth towards the bottom.
  // A point above the tear has both lips in its window.
  const Points points = imageOf(
      [](int column, int row) { return 1 + 0.001 * column + std::max(0, row - 15) * (column < 30 ? -0.02 : 0.02); });
  const Laplacian laplacian = imageLaplacian(points);
  for (int column = 0; column < laplacian.L.cols(); ++column) {
    for (SparseMatrix::InnerIterator entry(laplacian.L, column); entry; ++entry) {
      const auto row = static_cast<int>(entry.row());
      if (row / width < 22 || column / width < 22 || row == column || entry.value() == 0) continue;
      EXPECT_EQ(row % width < 30, column % width < 30) << row << ' ' << column;
    }
  }
}

TEST(ImageStars, WidenTheirWindowsWherePixelsAreMissing) {
  shapes::Random random(6);
  const Points points = imageOf(
      [&](int column, int row) { return random.uniform() < 0.9 ? std::nan("") : planeDepth(column, row, 0.2, 0.1); });
  const Laplacian laplacian = imageLaplacian(points);
  EXPECT_GT(laplacian.report.grown_neighborhoods, 0);
  EXPECT_EQ(laplacian.report.components, 1);
  EXPECT_EQ(laplacian.report.isolated, 0);
}

TEST(DepthImage, IsToldByItsRays) {
  const shapes::Cloud camera = shapes::depthCamera({.width = 80, .height = 60});
  EXPECT_TRUE(isDepthImage(camera.points, 80, 60));
  const Eigen::RowVector3d moved(10, -20, 3);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Points elsewhere = (camera.points * turn.transpose()).rowwise() + moved;
  EXPECT_TRUE(isDepthImage(elsewhere, 80, 60, moved));
  EXPECT_FALSE(isDepthImage(elsewhere, 80, 60)) << "another origin";
  EXPECT_FALSE(isDepthImage(camera.points, 60, 80)) << "other rows";
  EXPECT_FALSE(isDepthImage(camera.points.topRows(80), 80, 1));
  EXPECT_FALSE(isDepthImage(camera.points, 80, 59)) << "rows that are missing";
  EXPECT_FALSE(isDepthImage(Points::Constant(4800, 3, std::nan("")), 80, 60));
  const shapes::Cloud lidar = shapes::lidar({.rings = 16, .azimuth_step = 2});
  EXPECT_FALSE(isDepthImage(lidar.points, lidar.width, lidar.height));
  // Points in rows that no camera saw from the origin.
  Points hills(4800, 3);
  for (int i = 0; i < 4800; ++i) hills.row(i) << i % 80, i / 80, 5 * std::sin(0.2 * i);
  EXPECT_FALSE(isDepthImage(hills, 80, 60));
}

}  // namespace
}  // namespace tufted::boundary_test
