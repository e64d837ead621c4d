#include "view/shown_values.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tufted/view/picture.h"
#include "view/color_maps.h"
#include "view/ticks.h"

namespace tufted::shown_values_test {
namespace {

using view::rangesOf;
using view::ValueRange;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

void expectRange(const ValueRange& range, double low, double high) {
  EXPECT_DOUBLE_EQ(range.low, low);
  EXPECT_DOUBLE_EQ(range.high, high);
}

TEST(RangesOf, EvenValuesKeepTheirColours) {
  expectRange(rangesOf(FieldKind::scalar, Eigen::VectorXd::LinSpaced(1001, -1, 3)).usual, -1, 3);
}

TEST(RangesOf, FewOutliersHaveTheColourOfAnEnd) {
  Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(1001, 0, 1);
  values[0] = -1e6;
  values[1000] = 1e9;
  values[500] = nan;
  const view::ValueRanges ranges = rangesOf(FieldKind::scalar, values);
  EXPECT_NEAR(ranges.usual.low, -1.25, 0.01);  // the lower quartile, less three times the distance of the quartiles
  EXPECT_NEAR(ranges.usual.high, 2.25, 0.01);
  expectRange(ranges.all, -1e6, 1e9);
  EXPECT_NEAR(ranges.middle.low, 0.01, 0.002);
  EXPECT_NEAR(ranges.middle.high, 0.99, 0.002);
}

TEST(RangesOf, TheMiddle98PercentAlwaysHaveColoursOfTheirOwn) {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(1000);
  values.head(30).setConstant(1);
  values[999] = 50;
  expectRange(rangesOf(FieldKind::scalar, values).usual, 0, 1);
}

TEST(RangesOf, FollowTheKind) {
  const Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(101, 1, 3);
  expectRange(rangesOf(FieldKind::diverging, values).usual, -3, 3);
  expectRange(rangesOf(FieldKind::distance, values).usual, 0, 3);
  expectRange(rangesOf(FieldKind::scalar, values).usual, 1, 3);
  expectRange(rangesOf(FieldKind::scalar, Eigen::Vector2d(nan, nan)).usual, 0, 0);
}

TEST(ShownValues, OfPositiveOnesAreLogarithms) {
  const SceneField field = {"area", FieldKind::positive, Eigen::Vector4d(100, 0, -1, 0.001)};
  const Eigen::VectorXd values = view::shownValues(field, 0);
  EXPECT_DOUBLE_EQ(values[0], 2);
  EXPECT_TRUE(std::isnan(values[1]) && std::isnan(values[2]));
  EXPECT_DOUBLE_EQ(values[3], -3);
}

TEST(TicksOf, TellTheEndsApartWhereNumbersDifferInTheirLastDigits) {
  for (const double offset : {3.2e8, -3.2e8, 1.3e9, 1e50, 7e-30})
    for (const double share : {1e-3, 1e-6, 1e-9, 1e-12}) {
      const double span = share * std::abs(offset);
      const view::Ticks ticks = view::ticksOf(offset, offset + span);
      ASSERT_EQ(ticks.values.size(), ticks.texts.size());
      ASSERT_GE(ticks.values.size(), 3u) << offset << ' ' << span;
      EXPECT_LE(ticks.values.size(), 8u) << offset << ' ' << span;
      for (std::size_t i = 0; i < ticks.values.size(); ++i) {
        EXPECT_GE(ticks.values[i], offset - 1e-2 * span);
        EXPECT_LE(ticks.values[i], offset + 1.01 * span);
        EXPECT_LE(ticks.texts[i].size(), 12u) << ticks.texts[i];
        if (i > 0) {
          EXPECT_NE(ticks.texts[i], ticks.texts[i - 1]);
        }
      }
    }
  EXPECT_EQ(view::ticksOf(3.2e8, 3.2e8 + 60).offset, 3.2e8);
  EXPECT_EQ(view::ticksOf(3.2e8, 3.2e8 + 60).texts.back(), "60");
  EXPECT_EQ(view::ticksOf(0, 60).offset, 0);
}

TEST(LogarithmicTicks, AreRoundNumbersOnTheScale) {
  for (const double low : {-7.3, -0.2, 0.0, 4.0})
    for (const double span : {0.1, 0.9, 1.0, 2.2, 5.0, 30.0}) {
      const view::Ticks ticks = view::logarithmicTicksOf(low, low + span);
      ASSERT_EQ(ticks.values.size(), ticks.texts.size());
      EXPECT_GE(ticks.values.size(), 2u) << low << ' ' << span;
      EXPECT_LE(ticks.values.size(), 8u) << low << ' ' << span;
      for (const double value : ticks.values) {
        EXPECT_GE(value, low - 1e-6);
        EXPECT_LE(value, low + span + 1e-6);
      }
    }
  const view::Ticks ticks = view::logarithmicTicksOf(-4, 2);
  EXPECT_EQ(ticks.texts.front(), "10\u207b\u2074");
  EXPECT_EQ(ticks.texts[2], "0.01");
  EXPECT_EQ(ticks.texts.back(), "100");
}

/// A square in front of the eye, of which each half has one pair of coordinates of the same length.
Scene cutSquare(bool is_mesh) {
  constexpr int side = 40;
  Scene scene = {.title = "", .positions = Points(side * side, 3)};
  Eigen::MatrixXd coordinates(side * side, 2);
  for (int i = 0; i < side * side; ++i) {
    scene.positions.row(i) << 2.0 * (i % side) / (side - 1) - 1, 2.0 * (i / side) / (side - 1) - 1, 0;
    coordinates.row(i) << (i % side < side / 2 ? -0.95 : 0.95), 0;  // between two lines of the grid
  }
  scene.fields = {{"logmap", FieldKind::coordinates, coordinates}};
  if (!is_mesh) return scene;
  scene.triangles.resize(2 * (side - 1) * (side - 1), 3);
  int t = 0;
  for (int y = 0; y + 1 < side; ++y)
    for (int x = 0; x + 1 < side; ++x) {
      const int a = y * side + x;
      scene.triangles.row(t++) << a, a + 1, a + side + 1;
      scene.triangles.row(t++) << a, a + side + 1, a + side;
    }
  return scene;
}

TEST(PictureOf, CoordinatesAreNotBlendedAcrossTheirCut) {
  for (const bool is_mesh : {false, true}) {
    PictureOptions options = {.width = 200, .height = 200, .light = false, .legend = false};
    options.camera = {.eye = {0, 0, 1}, .up = {0, 1, 0}};
    const Picture picture = drawPicture(cutSquare(is_mesh), options);
    const Rgb expected = colorAt(colorMap("viridis", "test"), 1);
    for (int y = 50; y < 150; ++y)
      for (int x = 50; x < 150; ++x)
        for (std::size_t k = 0; k < 3; ++k)
          ASSERT_EQ(picture.pixels[4 * (static_cast<std::size_t>(y) * 200 + x) + k], expected[k]) << x << ' ' << y;
  }
}

/// A square seen from above, with x, coordinates around the middle, or vectors around it, in some unit.
Scene squareIn(double unit, double offset, FieldKind kind, bool is_mesh) {
  Scene scene = cutSquare(is_mesh);
  scene.title = "";
  Eigen::MatrixXd values = scene.positions.col(0);
  if (kind == FieldKind::coordinates) values = scene.positions.leftCols<2>();
  if (kind == FieldKind::vector) {
    values = Points::Zero(scene.positions.rows(), 3);
    values.leftCols<2>() << -scene.positions.col(1), scene.positions.col(0);
  }
  scene.fields = {{"values", kind, (offset + unit * values.array()).matrix()}};
  return scene;
}

TEST(PictureOf, LooksTheSameWhateverTheSizeOfItsNumbers) {
  for (const FieldKind kind : {FieldKind::scalar, FieldKind::coordinates, FieldKind::vector})
    for (const bool is_mesh : {false, true})
      for (const auto& [unit, offset] :
           {std::pair(1e-50, 0.0), {1e-290, 0.0}, {1e50, 0.0}, {1e300, 0.0}, {1.0, 3.2e8}, {1.0, -1e12}}) {
        if (offset != 0 && kind != FieldKind::scalar) continue;  // these begin at 0
        PictureOptions options = {.width = 200, .height = 200, .isolines = true, .legend = false};
        options.camera = {.eye = {0, 0, 1}, .up = {0, 1, 0}};
        const Picture expected = drawPicture(squareIn(1, 0, kind, is_mesh), options);
        const Picture picture = drawPicture(squareIn(unit, offset, kind, is_mesh), options);
        int others = 0;
        for (std::size_t i = 0; i < picture.pixels.size(); ++i)
          others += std::abs(picture.pixels[i] - expected.pixels[i]) > 3 ? 1 : 0;
        EXPECT_LT(others, 0.002 * static_cast<double>(picture.pixels.size()))
            << static_cast<int>(kind) << ' ' << unit << ' ' << offset << ' ' << is_mesh;
      }
}

}  // namespace
}  // namespace tufted::shown_values_test
