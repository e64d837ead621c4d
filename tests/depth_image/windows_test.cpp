// Which pixels around a pixel are of its surface.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "depth_image/image.h"
#include "shapes/random.h"
#include "tufted/errors.h"

namespace tufted::windows_test {
namespace {

using namespace image_tests;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

TEST(WindowPixels, AreAllAroundOnceFromTheNearestOn) {
  std::set<std::pair<int, int>> seen;
  int ring_before = 1;
  for (const auto& [row, column] : window_pixels.step) {
    seen.insert({row, column});
    const int ring = std::max(std::abs(row), std::abs(column));
    EXPECT_GE(ring, ring_before);
    ring_before = ring;
  }
  EXPECT_EQ(seen.size(), 48U);
  EXPECT_EQ(seen.count({0, 0}), 0U);
  EXPECT_EQ(WindowPixels::rings(1), 0xFFU);
}

TEST(PixelGrid, LeavesOutEmptyRowsAndColumns) {
  const Points points = imageOf([](int, int) { return 1.0; });
  ScanStructure sparse = imageStructure(width, height);
  for (int& row : sparse.row) row = 4 * row + (row > 20 ? 1000 : 0);
  for (double& column : sparse.position) column = 7 * column + 3;
  const Image whole(points), part(points, sparse);
  EXPECT_EQ(part.grid().rows, height + 2 * PixelGrid::margin);
  EXPECT_EQ(part.grid().columns, width + 2 * PixelGrid::margin);
  EXPECT_EQ(part.grid().rank, whole.grid().rank);
}

TEST(PixelGrid, GivesAPixelToOnePoint) {
  const Points points = imageOf([](int, int) { return 1.0; });
  ScanStructure structure = imageStructure(width, height);
  structure.position[1] = 0;  // two points in the first pixel
  structure.row[5] = -1;      // one in none
  const Image image(points, structure);
  int without = 0;
  for (int p = 0; p < image.cloud().size(); ++p) without += image.grid().pixel[p] < 0 ? 1 : 0;
  EXPECT_EQ(without, 2);
}

TEST(PixelGrid, RefusesRowsAndColumnsThatAreNoImage) {
  const Points points = imageOf([](int, int) { return 1.0; });
  ScanStructure structure = imageStructure(width, height);
  structure.position[7] = 2e9;
  EXPECT_THROW(Image(points, structure), InvalidInput);
}

TEST(SurfaceWindows, HoldEveryPixelOfAPlaneSeenAtAnyAngle) {
  for (const auto& slope : {std::pair(0.03, 0.01), std::pair(0.6, 0.1), std::pair(-0.2, 1.2), std::pair(1.5, 0.4)}) {
    const Image image(imageOf([&](int column, int row) { return planeDepth(column, row, slope.first, slope.second); }));
    for (int p = 0; p < image.cloud().size(); ++p) {
      const int column = image.pointOf(p) % width, row = image.pointOf(p) / width;
      if (std::min({column, row, width - 1 - column, height - 1 - row}) < 3) continue;
      ASSERT_EQ(image.windows().around[p], WindowPixels::rings(3))
          << slope.first << ' ' << slope.second << ' ' << column << ' ' << row;
    }
  }
}

TEST(SurfaceWindows, NeverReachAcrossADepthJump) {
  // From pixel to pixel the step to the nearer left part is within 4 degrees of the line of sight.
  const Image image(
      imageOf([](int column, int row) { return planeDepth(column, row, 0.03, 0.01) * (column < 30 ? 0.85 : 1); }));
  EXPECT_GT(image.windows().cut, 0);
  for (int p = 0; p < image.cloud().size(); ++p)
    for (const int q : image.aroundByPixels(p, 12))
      ASSERT_EQ(q % width < 30, image.pointOf(p) % width < 30) << image.pointOf(p) << " and " << q;
}

TEST(SurfaceWindows, TakeAJumpBelowTheNoiseForASurface) {
  const auto depth = [](int column, int) { return column < 30 ? 0.98 : 1; };
  const Points points = imageOf(depth);
  const auto reachesOver = [&](const Image& image) {
    for (int p = 0; p < image.cloud().size(); ++p)
      for (const int q : image.around(p))
        if ((q % width < 30) != (image.pointOf(p) % width < 30)) return true;
    return false;
  };
  // Scaled to the unit of the ranks, in which inverse ranges are.
  const double unit = std::ldexp(1.0, Image(points).cloud().exponent);
  EXPECT_TRUE(reachesOver(Image(points, 0.005 * unit)));
  const Points deeper = imageOf([](int column, int) { return column < 30 ? 0.6 : 1; });
  EXPECT_FALSE(reachesOver(Image(deeper, 0.005 * std::ldexp(1.0, Image(deeper).cloud().exponent))));
}

TEST(SurfaceWindows, StepOverPixelsWithoutAPoint) {
  const Image image(imageOf([](int column, int row) {
    return column % 3 == 1 && row % 2 == 0 ? none : planeDepth(column, row, 0.03, 0.01);
  }));
  for (int p = 0; p < image.cloud().size(); ++p) {
    const int column = image.pointOf(p) % width, row = image.pointOf(p) / width;
    if (std::min({column, row, width - 1 - column, height - 1 - row}) < 3) continue;
    int seen = 0;
    for (const auto& [r, c] : window_pixels.step) seen += (column + c) % 3 == 1 && (row + r) % 2 == 0 ? 0 : 1;
    ASSERT_EQ(image.around(p).size(), static_cast<std::size_t>(seen));
  }
}

TEST(SurfaceWindows, AreThoseFoundPixelByPixel) {
  // Pieces of surfaces at random depths, with holes: many tiles, margins and ways around.
  for (int seed = 1; seed <= 5; ++seed) {
    shapes::Random random(seed);
    std::vector<double> depths;
    for (int i = 0; i < 40; ++i) depths.push_back(0.8 + 0.5 * random.uniform());
    const Image image(imageOf([&](int column, int row) {
      const double depth = depths[(column / 9 + 7 * (row / 7)) % 40] * (1 + 0.02 * random.uniform());
      return random.uniform() < 0.2 ? none : depth;
    }));
    for (int p = 0; p < image.cloud().size(); ++p) ASSERT_EQ(image.around(p), image.aroundByPixels(p)) << p;
  }
}

}  // namespace
}  // namespace tufted::windows_test
