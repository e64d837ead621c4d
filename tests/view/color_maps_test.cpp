#include "view/color_maps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tufted/errors.h"

namespace color_maps_test {
namespace {

using tufted::ColorMap;
using tufted::FieldKind;
using tufted::MapUse;
using tufted::Rgb;

double differenceOf(const Rgb& a, const Rgb& b) {
  const auto p = tufted::toOklab(a);
  const auto q = tufted::toOklab(b);
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

TEST(ColorMaps, SequentialOnesGrowLighterInEvenSteps) {
  for (const ColorMap& map : tufted::colorMaps()) {
    if (map.use != MapUse::sequential) continue;
    ASSERT_EQ(map.colors.size(), 256u);
    const double span = tufted::toOklab(map.colors.back())[0] - tufted::toOklab(map.colors.front())[0];
    EXPECT_GT(span, 0.5) << map.name;
    for (std::size_t i = 16; i < 256; i += 16) {
      const double step = tufted::toOklab(map.colors[i])[0] - tufted::toOklab(map.colors[i - 16])[0];
      EXPECT_GT(step, 0.5 * span / 16) << map.name << i;
      EXPECT_LT(step, 2 * span / 16) << map.name << i;
    }
  }
}

TEST(ColorMaps, DivergingOnesAreLightestAndGreyInTheMiddle) {
  for (const ColorMap& map : tufted::colorMaps()) {
    if (map.use != MapUse::diverging) continue;
    const auto middle = tufted::toOklab(map.colors[128]);
    EXPECT_LT(std::hypot(middle[1], middle[2]), 0.02) << map.name;
    for (std::size_t i = 8; i < 128; i += 8) {
      EXPECT_GT(tufted::toOklab(map.colors[i])[0], tufted::toOklab(map.colors[i - 8])[0]) << map.name << i;
      EXPECT_LT(tufted::toOklab(map.colors[255 - i + 8])[0], tufted::toOklab(map.colors[255 - i])[0]) << map.name << i;
    }
    EXPECT_GT(differenceOf(map.colors.front(), map.colors.back()), 0.2) << map.name;  // twice that of labels
  }
}

TEST(ColorMaps, LabelsAreFarApartAndNoneIsTheGreyOfNoValue) {
  const ColorMap& map = tufted::colorMap("labels", "test");
  ASSERT_GE(map.colors.size(), 12u);
  for (std::size_t i = 0; i < map.colors.size(); ++i) {
    EXPECT_GT(differenceOf(map.colors[i], tufted::no_value_color), 0.08) << i;
    EXPECT_GT(differenceOf(map.colors[i], tufted::none_color), 0.08) << i;
    for (std::size_t j = 0; j < i; ++j) EXPECT_GT(differenceOf(map.colors[i], map.colors[j]), 0.1) << i << ' ' << j;
  }
}

TEST(ColorMaps, NegativeLabelsAndOddValuesAreDifferentGreys) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const ColorMap& labels = tufted::colorMap("labels", "test");
  EXPECT_EQ(tufted::labelColor(labels, -1), tufted::none_color);
  EXPECT_GT(differenceOf(tufted::none_color, tufted::no_value_color), 0.1);
  for (const double value : {nan, infinity, -infinity})
    EXPECT_EQ(tufted::labelColor(labels, value), tufted::no_value_color) << value;
  EXPECT_EQ(tufted::labelColor(labels, 3), tufted::labelColor(labels, 3 + static_cast<double>(labels.colors.size())));
  const ColorMap& viridis = tufted::colorMap("viridis", "test");
  EXPECT_EQ(tufted::colorAt(viridis, nan), tufted::no_value_color);
  EXPECT_EQ(tufted::colorAt(viridis, -infinity), viridis.colors.front());
  EXPECT_EQ(tufted::colorAt(viridis, infinity), viridis.colors.back());
}

TEST(ColorMaps, EachKindHasOneAndUnknownNamesAreRefused) {
  for (const FieldKind kind : {FieldKind::scalar, FieldKind::diverging, FieldKind::distance, FieldKind::label,
                               FieldKind::vector, FieldKind::coordinates})
    EXPECT_NO_THROW(tufted::colorMap(tufted::defaultColorMap(kind), "test"));
  EXPECT_EQ(tufted::defaultColorMap(FieldKind::color), "");
  EXPECT_THROW(tufted::colorMap("jet", "test"), tufted::InvalidInput);
}

TEST(ColorMaps, OklabKeepsColours) {
  for (const Rgb& color : {Rgb{0, 0, 0}, Rgb{255, 255, 255}, Rgb{255, 0, 0}, Rgb{12, 200, 99}})
    EXPECT_EQ(tufted::fromOklab(tufted::toOklab(color)), color);
}

}  // namespace
}  // namespace color_maps_test
