// Pictures of scans: plans, form without given normals, points of uneven density, directions, and marked sources.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tufted/view/picture.h"
#include "view/color_maps.h"
#include "view/marks.h"

namespace tufted::picture_scans_test {
namespace {

/// The edges of letters have up to so many pixels of any grey.
constexpr int few = 10;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Rgb pixelOf(const Picture& picture, int x, int y) {
  const std::uint8_t* const p = &picture.pixels[4 * (static_cast<std::size_t>(y) * picture.width + x)];
  return {p[0], p[1], p[2]};
}

int countOf(const Picture& picture, const Rgb& color) {
  int count = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) count += pixelOf(picture, x, y) == color ? 1 : 0;
  return count;
}

/// Adds side * side points of a square at height `z`, from (left, 0) on, with a label.
void addSquare(double left, double z, double width, int side, double label, Scene& scene) {
  if (scene.fields.empty()) scene = {.title = "", .positions = Points(0, 3), .fields = {{"f", FieldKind::label, {}}}};
  const Eigen::Index first = scene.positions.rows();
  scene.positions.conservativeResize(first + side * side, 3);
  scene.fields[0].values.conservativeResize(first + side * side, 1);
  for (int i = 0; i < side * side; ++i) {
    scene.positions.row(first + i) << left + width * (i % side) / (side - 1), width * (i / side) / (side - 1), z;
    scene.fields[0].values(first + i, 0) = label;
  }
}

Points wave(int count) {
  Points points(count, 3);
  for (int i = 0; i < count; ++i) points.row(i) << i % 6, i / 6, std::sin(i);
  return points;
}

PictureOptions fromAbove(bool is_parallel) {
  PictureOptions options = {.width = 400, .height = 300, .light = false, .legend = false};
  options.camera.azimuth = -90;
  options.camera.elevation = 90;
  options.camera.up = Eigen::Vector3d::UnitZ();
  options.camera.is_parallel = is_parallel;
  return options;
}

TEST(Plan, HasOneScaleAtAllHeights) {
  const ColorMap& map = colorMap("labels", "test");
  Scene scene;
  addSquare(0, 0, 1, 60, 0, scene);
  addSquare(2, 1, 1, 60, 1, scene);
  const auto ratio = [&](bool is_parallel) {
    const Picture picture = drawPicture(scene, fromAbove(is_parallel));
    return static_cast<double>(countOf(picture, map.colors[1])) / countOf(picture, map.colors[0]);
  };
  EXPECT_NEAR(ratio(true), 1, 0.02);
  EXPECT_GT(ratio(false), 1.2);  // the higher square is nearer to the eye
}

TEST(Plan, OfASlopeIsLinear) {
  Scene scene = {.title = "", .positions = Points(4, 3), .triangles = Triangles(2, 3)};
  scene.positions << -1, -1, -0.8, 1, -1, 0.8, 1, 1, 0.8, -1, 1, -0.8;
  scene.triangles << 0, 1, 2, 0, 2, 3;
  scene.fields = {{"x", FieldKind::scalar, scene.positions.col(0)}};
  PictureOptions options = fromAbove(true);
  options.width = options.height = 256;
  const Picture picture = drawPicture(scene, options);
  // The highest pixel rows and columns of the square tell the scale; x grows to the right.
  int left = 256, right = 0;
  for (int x = 0; x < 256; ++x)
    if (pixelOf(picture, x, 128) != Rgb{255, 255, 255}) left = std::min(left, x), right = std::max(right, x);
  EXPECT_NEAR(left + right, 255, 1);
  EXPECT_GT(right - left, 220);
  const ColorMap& map = colorMap("viridis", "test");
  for (int x = left + 3; x < right - 3; x += 3) {
    const Rgb expected = colorAt(map, (x - left + 0.5) / (right - left + 1));
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(pixelOf(picture, x, 100)[k], expected[k], 4) << x;
  }
}

TEST(Plan, HasNorthUp) {
  const ColorMap& map = colorMap("labels", "test");
  Scene scene;
  addSquare(0, 0, 1, 40, 0, scene);
  for (Eigen::Index i = 0; i < 1600; ++i)
    scene.fields[0].values(i, 0) = (scene.positions(i, 1) > 0.5) + 2 * (scene.positions(i, 0) > 0.5);
  const Picture picture = drawPicture(scene, fromAbove(true));
  EXPECT_EQ(pixelOf(picture, 150, 250), map.colors[0]);
  EXPECT_EQ(pixelOf(picture, 150, 50), map.colors[1]);
  EXPECT_EQ(pixelOf(picture, 250, 250), map.colors[2]);
}

TEST(Discs, OfSparsePointsDoNotHideDenseOnes) {
  const ColorMap& map = colorMap("labels", "test");
  Scene scene;
  addSquare(0, 0, 2, 100, 0, scene);
  addSquare(0.25, 0.5, 1.5, 5, 1, scene);
  scene.positions.bottomRows(25).col(1).array() += 0.25;
  const Picture picture = drawPicture(scene, fromAbove(true));
  EXPECT_GE(countOf(picture, map.colors[1]), 25);
  EXPECT_LT(countOf(picture, map.colors[1]), 0.05 * countOf(picture, map.colors[0]));
}

TEST(Discs, OfASparsePartLeaveNoHoles) {
  Scene scene;
  addSquare(0, 0, 2, 100, 0, scene);
  addSquare(2.03, 0, 2, 34, 1, scene);
  const Picture picture = drawPicture(scene, fromAbove(true));
  for (int y = 80; y < 220; ++y)
    for (int x = 30; x < 370; ++x) EXPECT_NE(pixelOf(picture, x, y), (Rgb{255, 255, 255})) << x << ' ' << y;
}

TEST(Discs, WithoutNormalsAreShadedAsWithThem) {
  std::mt19937_64 generator(7);
  const auto uniform = [&] { return static_cast<double>(generator() >> 11) * 0x1p-53; };
  Scene scene = {.title = "", .positions = Points(20'000, 3)};
  for (Eigen::Index i = 0; i < scene.positions.rows(); ++i) {
    Eigen::Vector3d p(2 * uniform() - 1, 2 * uniform() - 1, 2 * uniform() - 1);
    while (p.norm() > 1 || p.norm() < 0.1) p = {2 * uniform() - 1, 2 * uniform() - 1, 2 * uniform() - 1};
    scene.positions.row(i) = p.normalized();
  }
  PictureOptions options = {.width = 200, .height = 200, .legend = false};
  const Picture fitted = drawPicture(scene, options);
  scene.normals = scene.positions;
  const Picture given = drawPicture(scene, options);
  double difference = 0, spread = 0;
  int count = 0;
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x) {
      if (std::hypot(x - 99.5, y - 99.5) > 80) continue;
      difference += std::abs(pixelOf(fitted, x, y)[0] - pixelOf(given, x, y)[0]);
      spread += std::abs(none_color[0] - pixelOf(given, x, y)[0]);
      ++count;
    }
  EXPECT_GT(spread / count, 30);  // light and shadow
  EXPECT_LT(difference / count, 4);
}

TEST(Directions, HaveColoursOfTheirAxes) {
  Scene scene = {.title = "", .positions = wave(5)};
  Eigen::MatrixXd directions(5, 3);
  directions << 3, 0, 0, 0, -1e-300, 0, 0, 0, 1, 0, 0, 0, nan, 0, 0;
  scene.fields = {{"normals", FieldKind::direction, directions}};
  EXPECT_EQ(pointColors(scene),
            (std::vector<Rgb>{{255, 128, 128}, {128, 0, 128}, {128, 128, 255}, no_value_color, no_value_color}));
  EXPECT_NO_THROW(drawPicture(scene, {.width = 300, .height = 200, .color_map = "viridis"}));
}

TEST(Labels, NoneAndNoValueDiffer) {
  Scene scene = {.title = "", .positions = wave(30)};
  scene.fields = {{"boundary", FieldKind::label, Eigen::MatrixXd::Constant(30, 1, -1)}};
  const PictureOptions options = {.width = 300, .height = 200, .light = false};
  const Picture none = drawPicture(scene, options);
  scene.fields[0].values.setConstant(nan);
  const Picture no_value = drawPicture(scene, options);
  EXPECT_GT(countOf(none, none_color), 100);  // the box in the legend
  EXPECT_LT(countOf(none, no_value_color), few);
  EXPECT_GT(countOf(no_value, no_value_color), 100);
  EXPECT_LT(countOf(no_value, none_color), few);
}

TEST(Legend, SaysNothingOfPointsThatAreNotDrawn) {
  Scene scene = {.title = "", .positions = wave(30)};
  scene.positions(3, 1) = nan;
  scene.fields = {{"z", FieldKind::scalar, scene.positions.col(1)}};
  EXPECT_LT(countOf(drawPicture(scene, {.width = 300, .height = 200, .light = false}), no_value_color), few);
  scene.fields[0].values(4, 0) = nan;
  EXPECT_GT(countOf(drawPicture(scene, {.width = 300, .height = 200, .light = false}), no_value_color), 50);
}

TEST(Sources, OfDistancesAreMarkedUnlessTheyCoverAPart) {
  Scene scene;
  addSquare(0, 0, 2, 41, 0, scene);
  const auto marks = [&](FieldKind kind, Eigen::Index sources) {
    scene.fields[0] = {"distance", kind, Eigen::MatrixXd::Ones(scene.positions.rows(), 1)};
    scene.fields[0].values(0, 0) = 2;
    for (Eigen::Index k = 0; k < sources; ++k) scene.fields[0].values(20 * 41 + 20 + k, 0) = 0;
    return countOf(drawPicture(scene, fromAbove(true)), view::path_color);
  };
  EXPECT_EQ(marks(FieldKind::distance, 0), 0);
  const int one = marks(FieldKind::distance, 1);
  EXPECT_GT(one, 10);
  EXPECT_GT(marks(FieldKind::distance, 10), one);
  EXPECT_EQ(marks(FieldKind::distance, 65), 0);
  EXPECT_EQ(marks(FieldKind::scalar, 1), 0);
}

TEST(Sources, AreWhereTheirPointsAre) {
  Scene scene;
  addSquare(0, 0, 2, 41, 0, scene);
  scene.fields[0] = {"d", FieldKind::distance,
                     (scene.positions.rowwise() - scene.positions.row(20 * 41 + 20)).rowwise().norm()};
  const Picture picture = drawPicture(scene, fromAbove(true));
  EXPECT_EQ(pixelOf(picture, 200, 150), view::path_rim_color);  // the hole of the ring, in the middle of the square
}

}  // namespace
}  // namespace tufted::picture_scans_test
