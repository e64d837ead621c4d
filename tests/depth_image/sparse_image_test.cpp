// Depth images of which pixels are missing: in holes they stay images, all over or in a part they are no image any
// more.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "shapes/random.h"
#include "tufted/scan_structure.h"

namespace tufted::sparse_image_test {
namespace {

constexpr int width = 160, height = 120, pixels = width * height;
constexpr double focal = 150;

Eigen::RowVector3d rayOf(double column, double row) {
  return {(column - (width - 1) / 2.0) / focal, (row - (height - 1) / 2.0) / focal, 1};
}

/// A ball of radius .5 at 2 m before a wall at 3 m.
double ballDepth(const Eigen::RowVector3d& ray) {
  const double squares = ray.squaredNorm(), inside = 4 - squares * (4 - 0.25);
  return inside > 0 ? (2 - std::sqrt(inside)) / squares : 3;
}

/// A room: floor, ceiling, side walls, a back wall and a box that stands on the floor.
double roomDepth(const Eigen::RowVector3d& ray) {
  double depth = 4.5;
  if (ray.y() > 0) depth = std::min(depth, 1 / ray.y());
  if (ray.y() < 0) depth = std::min(depth, -1.2 / ray.y());
  if (ray.x() != 0) depth = std::min(depth, 1.7 / std::abs(ray.x()));
  const Eigen::RowVector3d box = 2.5 * ray;
  return box.x() >= -0.3 && box.x() <= 0.5 && box.y() >= 0.3 && box.y() <= 1 ? std::min(depth, 2.5) : depth;
}

/// What is seen in the pixels that `isThere`, with noise that grows with the square of the depth.
Points imageOf(double (*depth)(const Eigen::RowVector3d&), const std::function<bool(int, int)>& isThere, double noise,
               shapes::Random& random) {
  Points points = Points::Constant(pixels, 3, std::nan(""));
  for (int i = 0; i < pixels; ++i) {
    const Eigen::RowVector3d ray = rayOf(i % width, i / width);
    const double z = depth(ray), error = noise * z * z * random.normal();
    if (isThere(i % width, i / width)) points.row(i) = (z + error) * ray;
  }
  return points;
}

using Missing = std::function<bool(int, int)>;

Missing atRandom(double share, shapes::Random& random) {
  return [share, &random](int, int) { return random.uniform() >= share; };
}

/// Discs of up to 20 pixels and the upper third, as sky and dark things.
Missing inHoles(shapes::Random& random) {
  std::vector<Eigen::Vector3d> discs;
  for (int i = 0; i < 12; ++i) {
    Eigen::Vector3d& disc = discs.emplace_back();
    for (double& value : disc) value = random.uniform();
    disc = Eigen::Vector3d(width * disc[0], height * disc[1], 4 + 16 * disc[2]);
  }
  return [discs](int column, int row) {
    for (const Eigen::Vector3d& disc : discs)
      if (std::hypot(column - disc[0], row - disc[1]) < disc[2]) return false;
    return row > height / 3;
  };
}

/// The pixels that rays of a spinning scanner of so many rings hit, which are .2 degrees apart.
Missing onRings(int rings) {
  constexpr double step = 0.2 * std::numbers::pi / 180;
  std::vector<std::uint8_t> hit(pixels, 0);
  const double top = std::atan(height / 2 / focal);
  for (int ring = 0; ring < rings; ++ring)
    for (int i = -250; i <= 250; ++i) {
      const double up = top * ((2 * ring + 1.0) / rings - 1), aside = i * step;
      const double x = std::tan(aside), y = std::tan(up) / std::cos(aside);
      const auto column = std::lround(x * focal + (width - 1) / 2.0), row = std::lround(y * focal + (height - 1) / 2.0);
      if (column >= 0 && column < width && row >= 0 && row < height) hit[row * width + column] = 1;
    }
  return [hit](int column, int row) { return hit[row * width + column] != 0; };
}

TEST(SparseShare, IsThatOfTheSurfaceAndNotOfTheImage) {
  shapes::Random random(1);
  const auto shareOf = [&](const Missing& isThere) {
    return sparseShare(imageOf(ballDepth, isThere, 0, random), width, height);
  };
  EXPECT_EQ(shareOf(atRandom(0, random)), 0);
  EXPECT_LT(shareOf(atRandom(0.1, random)), 0.001);
  EXPECT_NEAR(shareOf(atRandom(0.5, random)), 0.5, 0.05);
  EXPECT_GT(shareOf(atRandom(0.9, random)), 0.99);
  // Only where holes lie close together are their rims sparse.
  for (int i = 0; i < 20; ++i) EXPECT_LT(shareOf(inHoles(random)), 0.025);
  EXPECT_GT(shareOf(onRings(16)), 0.9);
  EXPECT_GT(shareOf(onRings(64)), most_sparse);
  EXPECT_EQ(shareOf([](int, int) { return false; }), 0);
  // As in a build, rows and columns that hold nothing are no part of the image.
  EXPECT_EQ(shareOf([](int column, int row) { return column % 3 == 0 && row % 2 == 1; }), 0);
  const Points points = imageOf(ballDepth, atRandom(0.3, random), 0, random);
  EXPECT_EQ(sparseShare(points, width, height + 1), 0);
}

TEST(SparseShare, OfAPartIsTheShareOfItsArea) {
  const std::function<bool(int, int)> parts[] = {
      [](int, int row) { return row >= 51 && row < 70; },                               // a band
      [](int column, int row) { return std::hypot(column - 80, row - 60) < 25; },       // a disc
      [](int column, int row) { return (column / 15 + row / 15) % 2 == 0; },            // a chessboard
      [](int column, int row) { return (column + row) / 12 % 3 == 0; },                 // stripes
      [](int column, int row) { return column >= width - 35 && row >= height - 35; }};  // a corner
  shapes::Random random(2);
  for (const auto& isSparse : parts) {
    double area = 0;
    for (int i = 0; i < pixels; ++i) area += isSparse(i % width, i / width) ? 1. / pixels : 0;
    const auto isThere = [&](int column, int row) { return !isSparse(column, row) || random.uniform() < 0.15; };
    const Points points = imageOf(ballDepth, isThere, 5e-4, random);
    EXPECT_NEAR(sparseShare(points, width, height), area, 0.4 * area);  // its rim has points beside it
    EXPECT_FALSE(isDepthImage(points, width, height));
  }
}

/// Half of the image misses a share of its pixels at random, the other half none.
Missing onOneSide(double share, bool are_rows, shapes::Random& random) {
  return [share, are_rows, &random](int column, int row) {
    return (are_rows ? 2 * row < height : 2 * column < width) || random.uniform() >= share;
  };
}

TEST(IsDepthImage, UnlessOneSideIsSparse) {
  for (const auto depth : {ballDepth, roomDepth})
    for (const bool are_rows : {false, true}) {
      shapes::Random random(3);
      const auto isImage = [&](double missing) {
        return isDepthImage(imageOf(depth, onOneSide(missing, are_rows, random), 5e-4, random), width, height);
      };
      for (const double missing : {0.1, 0.2}) EXPECT_TRUE(isImage(missing)) << missing;
      for (const double missing : {0.5, 0.7, 0.9, 0.95}) EXPECT_FALSE(isImage(missing)) << missing;
    }
}

TEST(IsDepthImage, WherePixelsAreMissingInHolesAndNotAllOver) {
  for (const auto depth : {ballDepth, roomDepth})
    for (const double noise : {0.0, 5e-4}) {
      shapes::Random random(2);
      const auto isImage = [&](const Missing& isThere) {
        return isDepthImage(imageOf(depth, isThere, noise, random), width, height);
      };
      for (const double missing : {0.0, 0.1, 0.2, 0.3}) EXPECT_TRUE(isImage(atRandom(missing, random))) << missing;
      for (const double missing : {0.4, 0.5, 0.8}) EXPECT_FALSE(isImage(atRandom(missing, random))) << missing;
      EXPECT_TRUE(isImage(inHoles(random)));
      for (const int rings : {16, 32, 64}) EXPECT_FALSE(isImage(onRings(rings))) << rings;
      // Lines that hold nothing are left out, unless windows are stretched by that.
      EXPECT_TRUE(isImage([](int, int row) { return row % 6 == 0; }));
      EXPECT_TRUE(isImage([](int column, int row) { return row % 4 == 0 && column % 4 == 0; }));
      EXPECT_FALSE(isImage([](int, int row) { return row % 14 == 0; }));
      EXPECT_FALSE(isImage([](int column, int) { return column % 14 == 0; }));
    }
}

}  // namespace
}  // namespace tufted::sparse_image_test
