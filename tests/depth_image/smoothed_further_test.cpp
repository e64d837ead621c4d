// The second smoothing of ranges, a packet at a time, against a loop over pixels.
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "depth_image/smoothed_ranges.h"
#include "depth_image/window_pixels.h"
#include "shapes/random.h"

namespace tufted::smoothed_further_test {
namespace {

constexpr double noise = 1e-3;

/// An image without holes but for some, rank by rank along its rows, and smoothed ranges that still have noise.
struct Case {
  PixelGrid grid;
  SmoothedRanges smoothed;

  Case(int width, int height) {
    shapes::Random random(width + 100 * height);
    grid.rows = height + 2 * PixelGrid::margin;
    grid.columns = width + 2 * PixelGrid::margin;
    grid.rank.assign(static_cast<std::size_t>(grid.rows) * grid.columns, -1);
    for (int row = 0; row < height; ++row) {
      for (int column = 0; column < width; ++column) {
        if (random.uniform() < 0.002) continue;
        const int pixel = (row + PixelGrid::margin) * grid.columns + column + PixelGrid::margin;
        grid.rank[pixel] = static_cast<int>(grid.pixel.size());
        grid.pixel.push_back(pixel);
        const double step = column > 2 * width / 3 ? 0.1 : 0;
        const double inverse = 1 + step + 1e-4 * row - 2e-4 * column + 0.3 * noise * random.normal();
        smoothed.range.push_back({inverse, 0.1 * noise * noise});
        // Some have little noise beside their spacing and stay as they are.
        smoothed.spacing_squared.push_back(column % 11 == 7 ? noise * noise * 1e3 : 1e-8);
      }
    }
  }
};

/// What one pass does to one pixel.
double smoothedAt(const PixelGrid& grid, const RawBuffer<SmoothedRange>& before, double spacing_squared, int p,
                  int stride) {
  const int row = grid.rowOf(p), column = grid.columnOf(p);
  std::vector<std::array<double, 3>> joined = {{0, 0, before[p].inverse}};
  for (const PixelStep& step : window_pixels.step) {
    const int r = row + stride * step.row, c = column + stride * step.column;
    if (r < 0 || c < 0 || r >= grid.rows || c >= grid.columns) continue;
    const int q = grid.rank[r * grid.columns + c];
    if (q < 0) continue;
    const double most = 4 * std::sqrt(spacing_squared) * stride * step.ring() + 2 * noise;
    if (std::abs(before[q].inverse - before[p].inverse) <= most)
      joined.push_back({static_cast<double>(step.row), static_cast<double>(step.column), before[q].inverse});
  }
  const auto count = static_cast<Eigen::Index>(joined.size());
  if (count < 20) return before[p].inverse;
  const int terms = count == 49 ? 6 : 3;
  Eigen::MatrixXd base(count, terms);
  Eigen::VectorXd values(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto& [i, j, value] = joined[k];
    base.row(k).head(3) << 1, i, j;
    if (terms == 6) base.row(k).tail(3) << i * i, i * j, j * j;
    values[k] = value;
  }
  const Eigen::VectorXd fit = base.householderQr().solve(values);
  const double variance = (base * fit - values).squaredNorm() / static_cast<double>(count - terms);
  return variance <= 4 * noise * noise ? fit[0] : before[p].inverse;
}

TEST(SmoothedFurther, IsThatOfALoopOverPixelsForImagesOfAnySize) {
  for (const auto& [width, height] : {std::pair{70, 61}, {64, 20}, {61, 58}, {13, 90}, {1, 30}, {9, 7}, {57, 1}}) {
    Case image(width, height);
    RawBuffer<SmoothedRange> expected = image.smoothed.range;
    int changed = 0;
    for (const int stride : {3, 9}) {
      const RawBuffer<SmoothedRange> before = expected;
      for (int p = 0; p < std::ssize(expected); ++p) {
        if (!(before[p].variance > 0.01 * image.smoothed.spacing_squared[p])) continue;
        expected[p].inverse = smoothedAt(image.grid, before, image.smoothed.spacing_squared[p], p, stride);
        if (expected[p].inverse == before[p].inverse) continue;
        expected[p].variance = before[p].variance / 8;
        ++changed;
      }
    }
    const Progress silent;
    smoothFurther(image.grid, image.smoothed, noise, Workers(2, silent));
    for (int p = 0; p < std::ssize(expected); ++p) {
      ASSERT_NEAR(image.smoothed.range[p].inverse, expected[p].inverse, 1e-12) << width << " x " << height << ", " << p;
      ASSERT_NEAR(image.smoothed.range[p].variance, expected[p].variance, 1e-15) << p;
    }
    EXPECT_TRUE(changed > 0 || width < 13 || height < 7);
  }
}

}  // namespace
}  // namespace tufted::smoothed_further_test
