// Bodies that curve away from a camera without noise are one surface up to their last pixels.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "depth_image/image.h"

namespace tufted::steep_rim_test {
namespace {

using image_tests::height;
using image_tests::Image;
using image_tests::width;

constexpr int middle_row = height / 2, middle_column = width / 2, last = middle_column + 20;
constexpr double radius = 20.02;  // pixels

/// A cylinder 1 m away that stands upright, seen along its rays: none beyond its silhouette.
double cylinderDepth(int column) {
  const double aside = column - middle_column;
  return 1 + 0.04 * (radius - std::sqrt(radius * radius - aside * aside));
}

/// Whether the window of a pixel in the middle row holds another one beside it.
bool isJoined(const Image& image, int column, int next) {
  const int p = middle_row * width + column, q = middle_row * width + next;
  int rank = 0;
  while (image.pointOf(rank) != p) ++rank;
  const std::vector<int> around = image.around(rank, 1);
  return std::find(around.begin(), around.end(), q) != around.end();
}

TEST(SteepRim, IsOfTheSurfaceUpToTheLastPixelWithoutNoise) {
  const Points points = image_tests::imageOf([](int column, int) { return cylinderDepth(column); });
  const double step = cylinderDepth(last) - cylinderDepth(last - 1),
               before = cylinderDepth(last - 1) - cylinderDepth(last - 2);
  ASSERT_GT(step, 12 * 0.01 * cylinderDepth(last)) << "at less than 5 degrees";
  ASSERT_LT(before, 11 * 0.01 * cylinderDepth(last)) << "at more";
  const Image image(points);
  EXPECT_TRUE(isJoined(image, last - 1, last));
  EXPECT_TRUE(isJoined(image, last, last - 1));
  const Image noisy(points, 2e-4);
  EXPECT_FALSE(isJoined(noisy, last - 1, last));
}

TEST(SteepRim, EndsWhereAnotherSurfaceBegins) {
  // What lies behind is farther away than the rim goes on.
  const auto depth = [](int column, int) {
    return column < last ? cylinderDepth(column) : cylinderDepth(last - 1) + 0.3;
  };
  const Image image(image_tests::imageOf(depth));
  EXPECT_TRUE(isJoined(image, last - 2, last - 1));
  EXPECT_FALSE(isJoined(image, last - 1, last));
  EXPECT_FALSE(isJoined(image, last, last - 1));
}

TEST(SteepRim, IsNoStepFromAFlatSurface) {
  const Image image(image_tests::imageOf([](int column, int) { return column < last ? 1.0 : 1.13; }));
  EXPECT_FALSE(isJoined(image, last - 1, last));
}

}  // namespace
}  // namespace tufted::steep_rim_test
