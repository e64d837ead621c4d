// Jumps that are followed to where they run out in noise.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "depth_image/image.h"
#include "shapes/random.h"

namespace tufted::faint_jumps_test {
namespace {

using namespace image_tests;

constexpr double noise = 0.04;  // of the inverse depth, by a quarter of which pixels lie apart

/// Where a line between two bodies lies in a row.
int lineAt(int row, double slant) {
  return width / 2 + static_cast<int>(std::lround(slant * (row - height / 2)));
}

/// A wall, and a body to the left of a line through the image that is nearer by `jump(row)` of the inverse depth.
template <class Jump>
Points wallAndBody(int seed, double slant, const Jump& jump) {
  shapes::Random random(seed);
  return imageOf([&](int column, int row) {
    const double body = column < lineAt(row, slant) ? jump(row) : 0;
    return 1 / (1 + body + noise * random.normal());
  });
}

/// The same body turned by a quarter: rows for columns.
Points turned(const Points& points) {
  Points other(points.rows(), 3);
  const int side = height;  // of the square that both have in common
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      Eigen::RowVector3d point = points.row(row * width + column);
      if (column >= 5 && column < 5 + side) {
        const Eigen::RowVector3d from = points.row((column - 5) * width + row + 5);
        const double depth = from[2];
        point *= depth / point[2];
      }
      other.row(row * width + column) = point;
    }
  }
  return other;
}

/// In which inverse ranges are.
double unitOf(const Points& points) {
  return std::ldexp(1.0, Image(points).cloud().exponent);
}

Image imageIn(const Points& points, bool smooths) {
  return Image(points, noise * unitOf(points), smooths);
}

/// How many pairs of pixels see each other across the line in some rows.
int pairsAcross(const Image& image, double slant, int first_row, int last_row, bool is_turned) {
  int pairs = 0;
  for (int p = 0; p < image.cloud().size(); ++p) {
    const auto placeOf = [&](int point) {
      const int column = point % width, row = point / width;
      return is_turned ? std::pair(column - 5, row + 5) : std::pair(row, column);
    };
    const auto [row, column] = placeOf(image.pointOf(p));
    if (row < first_row || row > last_row) continue;
    for (const int q : image.around(p)) {
      const auto [other_row, other_column] = placeOf(q);
      if (other_row < first_row || other_row > last_row) continue;
      pairs += (column < lineAt(row, slant)) != (other_column < lineAt(other_row, slant)) ? 1 : 0;
    }
  }
  return pairs;
}

/// From 14 deviations down to none at the last row but ten; pixel by pixel 9 are told.
double runsOut(int row) {
  return std::max(0.0, 14 * noise * (1 - row / 40.0));
}

TEST(FaintJumps, AreFollowedToWhereTheyRunOut) {
  for (const double slant : {0.0, 0.2, -0.2}) {
    for (int seed = 1; seed <= 5; ++seed) {
      const Points points = wallAndBody(seed, slant, runsOut);
      for (const bool is_turned : {false, true}) {
        const Points seen = is_turned ? turned(points) : points;
        // From 8 to 5 deviations.
        EXPECT_GT(pairsAcross(imageIn(seen, false), slant, 18, 25, is_turned), 100);
        EXPECT_LE(pairsAcross(imageIn(seen, true), slant, 18, 25, is_turned), 20) << seed << ' ' << slant;
      }
    }
  }
}

TEST(FaintJumps, LeaveASurfaceInNoiseWhole) {
  const auto none = [](int) { return 0.0; };
  const auto crease = [](int row) { return 0.02 * std::abs(row - height / 2); };
  for (int seed = 1; seed <= 5; ++seed) {
    const Points flat = wallAndBody(seed, 0, none);
    EXPECT_EQ(imageIn(flat, true).windows().cut, imageIn(flat, false).windows().cut);
    shapes::Random random(seed);
    const Points bent = imageOf([&](int, int row) { return 1 / (1 + crease(row) + noise * random.normal()); });
    EXPECT_EQ(imageIn(bent, true).windows().cut, imageIn(bent, false).windows().cut);
  }
}

TEST(FaintJumps, AreLeftAloneWhereNoiseIsHarmless) {
  const Points points = imageOf([](int column, int row) { return 1 / (1 + (column < width / 2 ? runsOut(row) : 0)); });
  const double little = 1e-6 * unitOf(points);
  EXPECT_EQ(Image(points, little, true).windows().cut, Image(points, little, false).windows().cut);
  EXPECT_EQ(Image(points, little, true).windows().moved, 0);
}

}  // namespace
}  // namespace tufted::faint_jumps_test
