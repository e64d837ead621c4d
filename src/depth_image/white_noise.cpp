#include "depth_image/white_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "base/buffer.h"
#include "base/median.h"

namespace tufted {
namespace {

constexpr std::int64_t samples = 32000;
/// Only this share of the pixels is looked at, where fits left the least variance. Where shape left more, neighbours
/// lie on one side of the surface.
constexpr double quiet = 0.25;
constexpr double alike = 1 + 1e-9;  // variances that differ by rounding
/// Noise is white if this share of neighbours lies on one side of the surface. It has .47 about a quadratic over 7 x 7
/// pixels and .5 about the surface itself.
constexpr double least_on_one_side = 0.45, most_on_one_side = 0.56;

/// The side of the surface on which a pixel lies: 1 behind it, -1 in front of it, 0 where nothing was smoothed.
int sideOf(const PixelGrid& grid, const PointsView& points, const SmoothedRanges& smoothed, std::int64_t pixel) {
  const std::ptrdiff_t at = smoothed.atPixel(grid, pixel);
  if (smoothed.variance[at] == 0) return 0;
  return 1 / grid.depthOf(points.row(grid.rank[pixel])) < smoothed.inverse[at] ? 1 : -1;
}

}  // namespace

bool changesSidesFreely(const PixelGrid& grid, const PointsView& points, const SmoothedRanges& smoothed,
                        const RangeNoise& noise) {
  const std::int64_t end = std::ssize(grid.rank) - grid.columns;
  const std::int64_t stride = sampleStride(end, samples, grid.columns);
  const auto varianceAt = [&](std::int64_t pixel) {
    const std::ptrdiff_t at = smoothed.atPixel(grid, pixel);
    return smoothed.variance[at] / std::pow(noise.atInverse(smoothed.inverse[at]), 2);
  };
  Buffer<double> variances;
  variances.reserve(static_cast<std::size_t>(end / stride + 1));
  for (std::int64_t pixel = 0; pixel < end; pixel += stride)
    if (const double variance = varianceAt(pixel); variance > 0) variances.push_back(variance);
  if (variances.empty()) return false;
  const double most_variance = quantileOf(variances, quiet) * alike;

  struct Pairs {
    std::int64_t step;
    double all = 0, on_one_side = 0;
  };
  std::array<Pairs, 2> directions = {{{1}, {grid.columns}}};
  for (std::int64_t pixel = 0; pixel < end; pixel += stride) {
    const double variance = varianceAt(pixel);
    if (!(variance > 0 && variance <= most_variance)) continue;
    const int side = sideOf(grid, points, smoothed, pixel);
    for (Pairs& pairs : directions) {
      const int next = sideOf(grid, points, smoothed, pixel + pairs.step);
      pairs.all += next != 0 ? 1 : 0;
      pairs.on_one_side += next == side ? 1 : 0;
    }
  }
  return std::ranges::all_of(directions, [](const Pairs& pairs) {
    const double by_chance = std::sqrt(pairs.all);  // two standard deviations
    return pairs.all > 0 && pairs.on_one_side >= least_on_one_side * pairs.all - by_chance &&
           pairs.on_one_side <= most_on_one_side * pairs.all + by_chance;
  });
}

}  // namespace tufted
