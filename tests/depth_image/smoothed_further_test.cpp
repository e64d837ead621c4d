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

/// An image without holes but for some, and smoothed ranges that still have noise.
struct Case {
  PixelGrid grid;
  SmoothedRanges smoothed;

  Case(int width, int height, const Workers& workers) {
    shapes::Random random(width + 100 * height);
    grid.rows = height + 2 * PixelGrid::margin;
    grid.columns = width + 2 * PixelGrid::margin;
    smoothed.clear(grid, workers);
    for (int row = 0; row < height; ++row) {
      for (int column = 0; column < width; ++column) {
        if (random.uniform() < 0.002) continue;
        const std::ptrdiff_t at = smoothed.at(row + PixelGrid::margin, column + PixelGrid::margin);
        const double step = column > 2 * width / 3 ? 0.1 : 0;
        smoothed.inverse[at] = 1 + step + 1e-4 * row - 2e-4 * column + 0.3 * noise * random.normal();
        smoothed.variance[at] = 0.1 * noise * noise;
        // Some have little noise beside their spacing and stay as they are.
        smoothed.spacing_squared[at] = column % 11 == 7 ? noise * noise * 1e3 : 1e-8;
      }
    }
  }
};

/// What one pass does to one pixel.
double smoothedAt(const SmoothedRanges& image, const RawBuffer<double>& before, int row, int column, int stride) {
  const std::ptrdiff_t at = image.at(row, column);
  std::vector<std::array<double, 3>> joined = {{0, 0, before[at]}};
  for (const PixelStep& step : window_pixels.step) {
    const int r = row + stride * step.row, c = column + stride * step.column;
    if (r < 0 || c < 0 || r >= image.rows || c >= image.columns) continue;
    const double value = before[image.at(r, c)];
    const double most = 4 * std::sqrt(image.spacing_squared[at]) * stride * step.ring() + 2 * noise;
    if (std::abs(value - before[at]) <= most)
      joined.push_back({static_cast<double>(step.row), static_cast<double>(step.column), value});
  }
  const auto count = static_cast<Eigen::Index>(joined.size());
  if (count < 20) return before[at];
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
  return variance <= 4 * noise * noise ? fit[0] : before[at];
}

TEST(SmoothedFurther, IsThatOfALoopOverPixelsForImagesOfAnySize) {
  for (const auto& size : {std::pair{70, 61}, {64, 20}, {61, 58}, {13, 90}, {1, 30}, {9, 7}, {57, 1}}) {
    const int width = size.first, height = size.second;
    const Progress silent;
    const Workers workers(2, silent);
    Case image(width, height, workers);
    SmoothedRanges expected = image.smoothed;
    const auto forEachPixelOfImage = [&](const auto& visit) {
      for (int row = 0; row < image.grid.rows; ++row)
        for (int column = 0; column < image.grid.columns; ++column) visit(row, column, expected.at(row, column));
    };
    int changed = 0;
    for (const int stride : {3, 9}) {
      const RawBuffer<double> before = expected.inverse;
      forEachPixelOfImage([&](int row, int column, std::ptrdiff_t at) {
        if (!(expected.variance[at] > 0.01 * expected.spacing_squared[at])) return;
        expected.inverse[at] = smoothedAt(expected, before, row, column, stride);
        if (expected.inverse[at] == before[at]) return;
        expected.variance[at] /= 8;
        ++changed;
      });
    }
    smoothFurther(image.smoothed, noise, workers);
    forEachPixelOfImage([&](int row, int column, std::ptrdiff_t at) {
      const double value = image.smoothed.inverse[at];
      ASSERT_EQ(std::isnan(value), std::isnan(expected.inverse[at])) << row << ' ' << column;
      if (std::isnan(value)) return;
      ASSERT_NEAR(value, expected.inverse[at], 1e-12) << width << " x " << height << ", " << row << ' ' << column;
      ASSERT_NEAR(image.smoothed.variance[at], expected.variance[at], 1e-15) << row << ' ' << column;
    });
    EXPECT_TRUE(changed > 0 || width < 13 || height < 7);
  }
}

}  // namespace
}  // namespace tufted::smoothed_further_test
