// The second smoothing of ranges, a packet at a time, against a loop over pixels.
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
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
        const int from_ridge = row % 24 - 12;  // between planes that meet in valleys
        const double bend = row < 2 * height / 3 ? 0 : 8e-5 * from_ridge * from_ridge;
        smoothed.inverse[at] = 1 + step + bend + 1e-4 * row - 2e-4 * column + 0.3 * noise * random.normal();
        smoothed.variance[at] = 0.1 * noise * noise;
        // Some have little noise beside their spacing and stay as they are.
        smoothed.spacing_squared[at] = column % 11 == 7 ? noise * noise * 1e3 : 1e-8;
      }
    }
  }
};

/// A pixel of a window: its step, and the value there.
using Joined = std::vector<std::array<double, 3>>;

Joined windowOf(const SmoothedRanges& image, const RawBuffer<double>& before, int row, int column, int stride) {
  const std::ptrdiff_t at = image.at(row, column);
  Joined joined = {{0, 0, before[at]}};
  for (const PixelStep& step : window_pixels.step) {
    const int r = row + stride * step.row, c = column + stride * step.column;
    if (r < 0 || c < 0 || r >= image.rows || c >= image.columns) continue;
    const double value = before[image.at(r, c)];
    const double most = 4 * std::sqrt(image.spacing_squared[at]) * stride * step.ring() + 2 * noise;
    if (std::abs(value - before[at]) <= most)
      joined.push_back({static_cast<double>(step.row), static_cast<double>(step.column), value});
  }
  return joined;
}

/// A fit to the pixels of a window up to a ring.
struct WindowFit {
  double value = 0, variance = INFINITY;  ///< of the middle, of the residuals
};

WindowFit fitOf(const Joined& window, int terms, int rings) {
  Joined joined;
  for (const auto& pixel : window)
    if (std::abs(pixel[0]) <= rings && std::abs(pixel[1]) <= rings) joined.push_back(pixel);
  const auto count = static_cast<Eigen::Index>(joined.size());
  if (count < (rings == 3 ? 20 : 12)) return {};
  Eigen::MatrixXd base(count, terms);
  Eigen::VectorXd values(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto& [i, j, value] = joined[k];
    base.row(k).head(3) << 1, i, j;
    if (terms == 6) base.row(k).tail(3) << i * i, i * j, j * j;
    values[k] = value;
  }
  const Eigen::VectorXd fit = base.householderQr().solve(values);
  return {fit[0], (base * fit - values).squaredNorm() / static_cast<double>(count - terms)};
}

/// What one pass does to one pixel.
/// @param variance of the noise
/// @returns nothing where the pixel stays
std::optional<SmoothedRange> smoothedRange(const Joined& window, const SmoothedRange& before, double variance) {
  const bool is_whole = window.size() == 49;
  const int terms = is_whole ? 6 : 3;
  const double most = (is_whole ? 8 : 4) * variance;
  const WindowFit wide = fitOf(window, terms, 3), narrow = fitOf(window, terms, 2);
  if (wide.variance <= most) return SmoothedRange{wide.value, before.variance / 8};
  if (narrow.variance <= most) return SmoothedRange{narrow.value, before.variance / 4};
  return std::nullopt;
}

void expectThatOfALoopOverPixels(bool is_white) {
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
    int moved = 0;
    double least = is_white ? 0 : noise * noise, most = is_white ? 0.03 * noise * noise : 0, share = is_white ? 0.4 : 0;
    for (const int stride : {3, 9, 5, 2}) {
      const RawBuffer<double> before = expected.inverse;
      const auto isWanted = [&](std::ptrdiff_t at) {
        return expected.variance[at] > 0.0004 * expected.spacing_squared[at];
      };
      std::vector<double> left, variances;
      forEachPixelOfImage([&](int row, int column, std::ptrdiff_t at) {
        if (!isWanted(at)) return;
        const Joined window = windowOf(expected, before, row, column, stride);
        if (window.size() != 49) return;
        left.push_back(fitOf(window, 6, 3).variance);
        variances.push_back(expected.variance[at]);
      });
      if (!left.empty() && !is_white) {
        std::sort(left.begin(), left.end());
        std::sort(variances.begin(), variances.end());
        least = std::min(least, std::max(left[left.size() / 4], left[3 * left.size() / 4] / 2));
        share = least / variances[variances.size() / 2];
      }
      if (stride == 3 && !is_white) most = least;
      forEachPixelOfImage([&](int row, int column, std::ptrdiff_t at) {
        if (!isWanted(at)) return;
        const Joined window = windowOf(expected, before, row, column, stride);
        const double variance = std::max(least, std::min(most, share * expected.variance[at]));
        const auto after = smoothedRange(window, {before[at], expected.variance[at]}, variance);
        if (!after) return;
        ++moved;
        expected.inverse[at] = after->inverse;
        expected.variance[at] = after->variance;
      });
    }
    smoothFurther({noise, 0}, is_white, workers, image.smoothed);
    forEachPixelOfImage([&](int row, int column, std::ptrdiff_t at) {
      const double value = image.smoothed.inverse[at];
      ASSERT_EQ(std::isnan(value), std::isnan(expected.inverse[at])) << row << ' ' << column;
      if (std::isnan(value)) return;
      ASSERT_NEAR(value, expected.inverse[at], 1e-12) << width << " x " << height << ", " << row << ' ' << column;
      ASSERT_NEAR(image.smoothed.variance[at], expected.variance[at], 1e-15) << row << ' ' << column;
    });
    EXPECT_TRUE(moved > 0 || width < 13 || height < 7);
  }
}

TEST(SmoothedFurther, IsThatOfALoopOverPixelsForImagesOfAnySize) {
  expectThatOfALoopOverPixels(false);
}
TEST(SmoothedFurther, WhereNoiseIsWhiteIsThatOfALoopOverPixels) {
  expectThatOfALoopOverPixels(true);
}

}  // namespace
}  // namespace tufted::smoothed_further_test
