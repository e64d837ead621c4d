#include "depth_image/depth_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

#include "base/buffer.h"

namespace tufted {
namespace {

constexpr std::int64_t samples = 20000;
constexpr double jump = 0.04;      // of the range, between two pixels
constexpr double likely_jump = 6;  // standard deviations of the noise
constexpr double kept_at_first = 0.75, kept = 0.9;
constexpr double spread_at_first = 0.37, spread = 0.62;  // mean square of the smallest, of normal numbers
constexpr double sum_of_squares = 70;                    // of 1, 4, 6, 4, 1

/// Inverse ranges of five pixels in a row.
using Five = std::array<double, 5>;

Buffer<Five> takeFives(const PixelGrid& grid, const PointsView& points) {
  const auto inverseRange = [&](std::int64_t pixel) {
    const int p = grid.rank[pixel];
    return p < 0 ? std::numeric_limits<double>::quiet_NaN() : 1 / (points.row(p) - grid.origin).norm();
  };
  Buffer<Five> fives;
  const std::int64_t pixels = std::ssize(grid.rank), stride = std::max<std::int64_t>(1, pixels / samples) | 1;
  for (std::int64_t pixel = 2 * grid.columns; pixel < pixels - 2 * grid.columns; pixel += stride) {
    if (grid.rank[pixel] < 0) continue;
    for (const std::int64_t side : {std::int64_t{1}, std::int64_t{grid.columns}}) {
      Five w;
      for (int i = 0; i < 5; ++i) w[i] = inverseRange(pixel + (i - 2) * side);
      if (std::isfinite(w[0] + w[1] + w[2] + w[3] + w[4])) fives.push_back(w);
    }
  }
  return fives;
}

/// The standard deviation by the smallest fourth differences of those without a jump.
/// @param least step of inverse ranges that may be a jump
double noiseOf(const Buffer<Five>& fives, double least, double share, double mean_square) {
  Buffer<double> squares;
  for (const Five& w : fives) {
    const auto jumps = [least](double a, double b) { return std::abs(a - b) > std::max(least, jump * std::min(a, b)); };
    if (std::adjacent_find(w.begin(), w.end(), jumps) != w.end()) continue;
    const double difference = w[0] - 4 * w[1] + 6 * w[2] - 4 * w[3] + w[4];
    squares.push_back(difference * difference);
  }
  const auto count = static_cast<std::ptrdiff_t>(share * static_cast<double>(squares.size()));
  if (count == 0) return 0;
  std::nth_element(squares.begin(), squares.begin() + count, squares.end());
  std::sort(squares.begin(), squares.begin() + count);  // so that the sum has the same bits whatever came before
  const double sum = std::accumulate(squares.begin(), squares.begin() + count, 0.0);
  return std::sqrt(sum / static_cast<double>(count) / mean_square / sum_of_squares);
}

}  // namespace

double inverseRangeNoise(const PixelGrid& grid, const PointsView& points) {
  const Buffer<Five> fives = takeFives(grid, points);
  const double at_first = noiseOf(fives, std::numeric_limits<double>::infinity(), kept_at_first, spread_at_first);
  return noiseOf(fives, likely_jump * at_first, kept, spread);
}

}  // namespace tufted
