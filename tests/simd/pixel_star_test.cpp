// Planes and stars of eight pixels at once against the ones that are found point by point.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "shapes/random.h"
#include "simd/kernels.h"
#include "stars/delaunay_star.h"
#include "stars/tangent_frame.h"

namespace tufted::pixel_star_test {
namespace {

/// Points of a surface with the inverse depth 1 + slope . (x, y) + curvature (x^2 - y^2), in pixels of a hundredth.
struct Surface {
  double slope_x = 0, slope_y = 0, curvature = 0, noise = 0;
  bool is_mirrored = false;

  Eigen::Vector3d at(double row, double column, shapes::Random& random) const {
    const double x = (is_mirrored ? -0.01 : 0.01) * column, y = 0.01 * row;
    const double inverse = 1 + slope_x * x + slope_y * y + curvature * (x * x - y * y) + noise * random.normal();
    return Eigen::Vector3d(x, y, 1) / inverse;
  }
};

struct Lane {
  Eigen::Vector3d sight;
  Eigen::Matrix<double, 3, pixels_around> offset;
};

Lane laneOf(const Surface& surface, shapes::Random& random) {
  Lane lane{surface.at(0, 0, random), {}};
  for (int i = 0; i < pixels_around; ++i)
    lane.offset.col(i) = surface.at(around_row[i], around_column[i], random) - lane.sight;
  return lane;
}

void put(const Lane& from, int lane, PixelsAround& around) {
  for (int i = 0; i < pixels_around; ++i) {
    around.x[i][lane] = from.offset(0, i);
    around.y[i][lane] = from.offset(1, i);
    around.z[i][lane] = from.offset(2, i);
  }
  around.sight_x[lane] = from.sight[0];
  around.sight_y[lane] = from.sight[1];
  around.sight_z[lane] = from.sight[2];
}

Eigen::Vector3d normalOf(const PixelStars& stars, int lane) {
  return {stars.normal_x[lane], stars.normal_y[lane], stars.normal_z[lane]};
}

/// The numbers of the link, counterclockwise around the normal.
std::vector<int> linkOf(const PixelStars& stars, int lane) {
  std::vector<int> link;
  for (int i = 0; i < 8; ++i)
    if (i % 2 == 0 || (stars.has_corner[i / 2] >> lane & 1U) != 0) link.push_back(i);
  if ((stars.is_mirrored >> lane & 1U) != 0) std::reverse(link.begin(), link.end());
  return link;
}

DelaunayStar starOf(const Lane& lane, const Eigen::Vector3d& normal) {
  const Eigen::Vector3d x = tangentOf(normal), y = normal.cross(x);
  Buffer<PlanarPoint> candidates;
  for (int i = 0; i < pixels_around; ++i)
    candidates.push_back({100 * x.dot(lane.offset.col(i)), 100 * y.dot(lane.offset.col(i)), i});
  StarScratch scratch;
  DelaunayStar star;
  delaunayStar(candidates, pixels_around, scratch, star);
  return star;
}

/// Surfaces up to 80 degrees from the front, smooth and rough, of an image and its mirror image.
std::vector<Surface> surfaces(int count) {
  shapes::Random random(3);
  std::vector<Surface> all;
  for (int i = 0; i < count; ++i) {
    const double slope = std::tan(80 / 57.3 * random.uniform()), direction = 6.283 * random.uniform();
    all.push_back({slope * std::cos(direction), slope * std::sin(direction), i % 3 == 0 ? 4 * random.normal() : 0,
                   i % 4 == 0 ? 0.005 * random.uniform() : 0, i % 2 == 0});
  }
  return all;
}

TEST(PixelStar, OfTheShortCutIsThatOfTheExactWay) {
  shapes::Random random(1);
  int certain = 0, near_front = 0, certain_near_front = 0;
  for (const Surface& surface : surfaces(4000)) {
    const Lane lane = laneOf(surface, random);
    PixelsAround around{};
    put(lane, 5, around);
    PixelStars stars;
    kernels().wrapPixels(around, stars);
    ASSERT_TRUE(stars.is_found >> 5 & 1U);

    // The plane: least squares of positions by rows and columns.
    Eigen::Vector3d by_row(0, 0, 0), by_column(0, 0, 0);
    for (int i = 0; i < pixels_around; ++i) {
      by_row += around_row[i] * lane.offset.col(i);
      by_column += around_column[i] * lane.offset.col(i);
    }
    Eigen::Vector3d normal = by_row.cross(by_column).normalized();
    if (normal.dot(lane.sight) > 0) normal = -normal;
    ASSERT_LT((normalOf(stars, 5) - normal).norm(), 1e-12);
    EXPECT_NEAR(stars.fit_radius[5], std::sqrt(2 * lane.offset.squaredNorm() / pixels_around), 1e-12);

    const bool is_near_front = std::hypot(surface.slope_x, surface.slope_y) < 1 && surface.noise == 0;
    near_front += is_near_front ? 1 : 0;
    if ((stars.is_certain >> 5 & 1U) == 0) continue;
    ++certain;
    certain_near_front += is_near_front ? 1 : 0;
    const DelaunayStar exact = starOf(lane, normal);
    ASSERT_TRUE(exact.closed);
    std::vector<int> link = linkOf(stars, 5);
    ASSERT_EQ(link.size(), exact.link.size());
    const auto first = std::find_if(exact.link.begin(), exact.link.end(),
                                    [&](const PlanarPoint& q) { return q.index == link.front(); });
    ASSERT_NE(first, exact.link.end());
    const auto shift = static_cast<std::size_t>(first - exact.link.begin());
    const bool is_mirrored = (stars.is_mirrored >> 5 & 1U) != 0;
    for (std::size_t i = 0; i < link.size(); ++i) {
      const std::size_t there = (i + shift) % link.size();
      ASSERT_EQ(link[i], exact.link[there].index);
      const int edge = is_mirrored ? link[(i + 1) % link.size()] : link[i];
      EXPECT_NEAR(stars.radius[edge][5] * 100, exact.radius[there], 1e-6 * exact.radius[there]);
    }
  }
  EXPECT_GT(near_front, 800);
  EXPECT_GT(certain_near_front, 0.97 * near_front);
  EXPECT_GT(certain, 2400);
}

TEST(PixelStar, OfStretchedImagesMayReachBeyondTheColumns) {
  // Rows lie six times as far apart as columns: the circles are wider than three columns.
  const double bend = 0.1;  // no four points lie on a circle
  Lane lane{Eigen::Vector3d(0, 0, 1), {}};
  for (int i = 0; i < pixels_around; ++i) {
    const double row = around_row[i], column = around_column[i];
    lane.offset.col(i) << 0.01 * (column + bend * row), 0.06 * row, 0;
  }
  PixelsAround around{};
  put(lane, 0, around);
  PixelStars stars;
  kernels().wrapPixels(around, stars);
  EXPECT_EQ(stars.is_certain & 1U, 0U);
  around.is_stretched = true;
  for (const Kernels* some : {&kernels(), &portableKernels()}) {
    some->wrapPixels(around, stars);
    EXPECT_EQ(stars.is_certain & 1U, 1U);
  }
  // The row after the next one nearer than the circles reach.
  for (int i = 0; i < pixels_around; ++i)
    if (std::abs(around_row[i]) == 2) lane.offset(1, i) /= 3;
  put(lane, 0, around);
  kernels().wrapPixels(around, stars);
  EXPECT_EQ(stars.is_certain & 1U, 0U);
}

TEST(PixelStar, OfEachLaneIsAsIfItWereAloneOnAnyProcessor) {
  shapes::Random random(2);
  const std::vector<Surface> all = surfaces(80);
  for (std::size_t first = 0; first < all.size(); first += 8) {
    PixelsAround together{};
    std::vector<Lane> lanes;
    for (int l = 0; l < 8; ++l) {
      lanes.push_back(laneOf(all[first + l], random));
      put(lanes.back(), l, together);
    }
    PixelStars stars, portable;
    kernels().wrapPixels(together, stars);
    portableKernels().wrapPixels(together, portable);
    for (int l = 0; l < 8; ++l) {
      PixelsAround around{};
      put(lanes[l], 0, around);
      PixelStars alone;
      kernels().wrapPixels(around, alone);
      for (const PixelStars* some : {&stars, &portable}) {
        EXPECT_EQ(some->is_certain >> l & 1U, alone.is_certain & 1U);
        EXPECT_EQ(normalOf(*some, l), normalOf(alone, 0));
        for (int e = 0; e < 8; ++e) EXPECT_EQ(some->radius[e][l], alone.radius[e][0]);
        for (int c = 0; c < 4; ++c) EXPECT_EQ(some->has_corner[c] >> l & 1U, alone.has_corner[c] & 1U);
      }
    }
  }
}

TEST(PixelStar, IsNotCertainOfTiesFoldsAndLines) {
  shapes::Random random(4);
  PixelsAround around{};
  put(laneOf({}, random), 0, around);  // squares: four points on each circle
  Lane fold = laneOf({0.3, 0.2}, random);
  fold.offset.col(0) = -fold.offset.col(0);  // the pixel below lies above
  put(fold, 1, around);
  Lane line = laneOf({0.3, 0.2}, random);
  line.offset.bottomRows(2).setZero();
  put(line, 2, around);
  Lane far = laneOf({0.3, 0.2}, random);
  far.offset.leftCols(8) *= 40;  // the second ring is nearer than the first
  put(far, 3, around);
  Lane wide = laneOf({5, 2.1}, random);  // the link goes beyond the eight around
  put(wide, 4, around);
  Lane missing = laneOf({0.3, 0.2}, random);
  missing.offset.setConstant(NAN);
  put(missing, 5, around);
  Lane star = laneOf({}, random);  // a pentagram: it turns left everywhere, and goes around twice
  for (const auto& [pixel, angle] : {std::pair{0, 0.0}, {1, 144.0}, {2, 288.0}, {4, 72.0}, {6, 216.0}})
    star.offset.col(pixel) << 0.01 * std::cos(angle / 57.29578), 0.01 * std::sin(angle / 57.29578), 0;
  for (const int pixel : {3, 5, 7}) star.offset.col(pixel) *= 8;
  star.offset.rightCols(16) *= 8;
  put(star, 6, around);
  PixelStars stars;
  kernels().wrapPixels(around, stars);
  EXPECT_EQ(stars.is_certain, 0U);
  EXPECT_EQ(stars.is_found & 0x24U, 0U);
  EXPECT_EQ(stars.is_found & 0x11U, 0x11U);
}

}  // namespace
}  // namespace tufted::pixel_star_test
