// What pictures choose by themselves: from where they are seen, and what the legend says.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tufted/view/picture.h"

namespace tufted::picture_choices_test {
namespace {

bool isBackground(const Picture& picture, int x, int y) {
  const std::uint8_t* const pixel = &picture.pixels[4 * (static_cast<std::size_t>(y) * picture.width + x)];
  return std::equal(pixel, pixel + 4, picture.pixels.data());
}

TEST(PictureChoices, ALineIsSeenFromAside) {
  // From the origin, where a sensor might be, along its direction, and elsewhere.
  for (const Eigen::RowVector3d& direction : {Eigen::RowVector3d(1, 2, 3), Eigen::RowVector3d(0, 0, 1),
                                              Eigen::RowVector3d(0, 1, 0), Eigen::RowVector3d(1, 0, 0)}) {
    for (const double start : {0.0, 3.0}) {
      for (const int count : {2, 300}) {
        Scene line = {.title = "Line", .positions = Points(count, 3)};
        for (int i = 0; i < count; ++i) line.positions.row(i) = (start + i / (count - 1.0)) * direction;
        const Picture picture = drawPicture(line, {.width = 120, .height = 120, .legend = false});
        int left = 120, right = 0, top = 120, bottom = 0;
        for (int y = 0; y < 120; ++y) {
          for (int x = 0; x < 120; ++x) {
            if (isBackground(picture, x, y)) continue;
            left = std::min(left, x), right = std::max(right, x);
            top = std::min(top, y), bottom = std::max(bottom, y);
          }
        }
        EXPECT_GT(std::hypot(right - left, bottom - top), 70) << direction << ", " << start << ", " << count;
      }
    }
  }
}

TEST(PictureChoices, AColumnWithANameHasItInTheLegend) {
  Scene scene = {.title = "Plane", .positions = Points::Zero(100, 3)};
  for (int i = 0; i < 100; ++i) scene.positions.row(i) << i % 10, i / 10, 0;
  scene.fields = {{.name = "both", .values = scene.positions.leftCols(2), .column_names = {"one", "two"}}};
  Scene named = scene;
  named.fields[0] = {.name = "two", .values = scene.positions.col(1)};
  const auto pixels = [](const Scene& shown, int column) {
    return drawPicture(shown, {.width = 300, .height = 200, .column = column}).pixels;
  };
  EXPECT_EQ(pixels(scene, 1), pixels(named, 0));
}

TEST(PictureChoices, LongNamesAreReadToTheirLastLetter) {
  Scene scene = {.title = "", .positions = Points::Zero(100, 3)};
  for (int i = 0; i < 100; ++i) scene.positions.row(i) << i % 10, i / 10, 0;
  const auto pixels = [&](const std::string& title, const std::string& name, const std::string& label) {
    Scene named = scene;
    named.title = title;
    named.fields = {{.name = name,
                     .kind = label.empty() ? FieldKind::scalar : FieldKind::label,
                     .values = label.empty() ? Eigen::MatrixXd(scene.positions.col(0)) : Eigen::MatrixXd::Zero(100, 1),
                     .label_names = {label}}};
    return drawPicture(named, {.width = 300, .height = 200}).pixels;
  };
  // Names that are cut before their last letter look the same.
  EXPECT_NE(pixels("t", "signed_distance", ""), pixels("t", "signed_distancf", ""));
  EXPECT_NE(pixels("t", "measured position 17", ""), pixels("t", "measured position 18", ""));
  EXPECT_NE(pixels("t", "displacementfields", ""), pixels("t", "displacementfieldz", ""));
  EXPECT_NE(pixels("t", "a", "low vegetation"), pixels("t", "a", "low vegetatiom"));
  EXPECT_NE(pixels("signed-distance: bildstein_station_3.ply", "a", ""),
            pixels("signed-distance: bildstein_station_3.plz", "a", ""));
}

}  // namespace
}  // namespace tufted::picture_choices_test
