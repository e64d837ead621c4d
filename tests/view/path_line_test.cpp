// Paths in pictures and pages.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tufted/view/page.h"
#include "tufted/view/picture.h"
#include "view/marks.h"

namespace tufted::path_line_test {
namespace {

using view::path_color;
using view::path_rim_color;

constexpr int size = 300;

/// A square of side 2 at z = 0, seen from above, and a path along y = 0 at a height.
Scene squareWithPath(double height, bool as_mesh) {
  constexpr int side = 41;
  Scene scene = {.title = "Square", .positions = Points(side * side, 3)};
  for (int i = 0; i < side * side; ++i)
    scene.positions.row(i) << 2.0 * (i % side) / (side - 1) - 1, 2.0 * (i / side) / (side - 1) - 1, 0;
  if (as_mesh) {
    scene.triangles.resize(2 * (side - 1) * (side - 1), 3);
    for (int k = 0; k < (side - 1) * (side - 1); ++k) {
      const int i = k / (side - 1) * side + k % (side - 1);
      scene.triangles.row(2 * k) << i, i + 1, i + side;
      scene.triangles.row(2 * k + 1) << i + side, i + 1, i + side + 1;
    }
  }
  scene.path.resize(3, 3);
  scene.path << -0.7, 0, height, 0.1, 0, height, 0.7, 0, height;
  return scene;
}

Picture fromAbove(const Scene& scene) {
  return drawPicture(
      scene,
      {.width = size, .height = size, .light = false, .legend = false, .camera = {.eye = {0, 0, 1}, .up = {0, 1, 0}}});
}

const std::uint8_t* pixelOf(const Picture& picture, int x, int y) {
  return &picture.pixels[4 * (static_cast<std::size_t>(y) * size + x)];
}

/// Whether a pixel is at least partly of the path; the surface is grey.
bool isRed(const Picture& picture, int x, int y) {
  const std::uint8_t* const pixel = pixelOf(picture, x, y);
  return pixel[0] > pixel[1] + 30;
}

/// The columns in which a picture has red.
std::vector<int> redColumns(const Picture& picture) {
  std::vector<int> columns;
  for (int x = 0; x < size; ++x) {
    bool is_red = false;
    for (int y = 0; y < size; ++y) is_red = is_red || isRed(picture, x, y);
    if (is_red) columns.push_back(x);
  }
  return columns;
}

TEST(PathLine, OnASurfaceRunsFromEndToEnd) {
  for (const bool as_mesh : {false, true}) {
    const std::vector<int> columns = redColumns(fromAbove(squareWithPath(0, as_mesh)));
    ASSERT_GT(std::ssize(columns), size / 2) << as_mesh;
    EXPECT_NEAR(columns.front() + columns.back(), size - 1, 4) << as_mesh;
    // But for the white rims of the two ends there is no gap.
    EXPECT_LE(columns.back() - columns.front() + 1 - std::ssize(columns), 6) << as_mesh;
  }
}

TEST(PathLine, UnderASurfaceIsDashed) {
  for (const bool as_mesh : {false, true}) {
    const auto shown = std::ssize(redColumns(fromAbove(squareWithPath(0, as_mesh))));
    const auto hidden = std::ssize(redColumns(fromAbove(squareWithPath(-0.4, as_mesh))));
    EXPECT_GT(hidden, shown / 4) << as_mesh;
    EXPECT_LT(hidden, 3 * shown / 4) << as_mesh;
  }
}

TEST(PathLine, BeginsWithARing) {
  const Picture picture = fromAbove(squareWithPath(0, true));
  const std::vector<int> columns = redColumns(picture);
  const auto colorOf = [&](int x) {
    const std::uint8_t* const pixel = pixelOf(picture, x, size / 2);
    return Rgb{pixel[0], pixel[1], pixel[2]};
  };
  const int radius = 4;  // of the circles
  EXPECT_EQ(colorOf(columns.front() + radius - 1), path_rim_color);
  EXPECT_EQ(colorOf(columns.back() - radius + 1), path_color);
}

TEST(PathLine, OfOddCornersIsDefined) {
  Scene scene = squareWithPath(0, false);
  const std::vector<std::uint8_t> none = fromAbove({.title = "", .positions = scene.positions}).pixels;
  scene.path.setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(fromAbove(scene).pixels, none);
  scene.path.setConstant(1e300);
  fromAbove(scene);
  scene.path = Points::Zero(1, 3);
  EXPECT_NE(fromAbove(scene).pixels, none);
  scene.path.resize(2, 3);
  scene.path << 0, 0, 0, 0, 0, 1e9;  // through the eye
  fromAbove(scene);
}

TEST(PathLine, IsInThePage) {
  const Scene scene = squareWithPath(0, false);
  EXPECT_NE(pageOf(scene).find("\"path\":"), std::string::npos);
  EXPECT_EQ(pageOf({.title = "", .positions = scene.positions}).find("\"path\":"), std::string::npos);
}

}  // namespace
}  // namespace tufted::path_line_test
