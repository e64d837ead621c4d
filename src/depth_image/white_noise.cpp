#include "depth_image/white_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>

#include "base/buffer.h"
#include "base/median.h"

namespace tufted {
namespace {

/// Number of sampled pixels, of which at least a quarter is tested: the share of pairs is then off by 0.006.
constexpr std::int64_t tried_pixels = 32000;
/// Only this share of the pixels is tested, those with the least residual variance. Where shape left more, neighbours
/// lie on one side of the surface: of a relief of squares 20 pixels wide and 4 sigma high all pixels have 0.54.
constexpr double tested_share = 0.25;
/// Variances that differ by less than this factor count as equal: most fits have exactly the variance of the noise.
constexpr double equal_variances = 1 + 1e-9;
/// Noise is white if the share of pairs of neighbours on one side of the surface is between these: white noise has 0.46
/// to 0.50, real cameras have 0.62 to 0.73, coarse depths 0.74 and more, waves of 10 and 12 pixels 0.61 and 0.57.
constexpr double least_on_one_side = 0.45, most_on_one_side = 0.56;

/// The side of the surface on which a pixel lies: 1 behind, -1 in front, 0 if it was not smoothed.
int sideOf(const PixelGrid& grid, const PointsView& points, const SmoothedRanges& smoothed, std::int64_t pixel) {
  const std::ptrdiff_t at = smoothed.atPixel(grid, pixel);
  if (smoothed.variance[at] == 0) return 0;
  return 1 / grid.depthOf(points.row(grid.rank[pixel])) < smoothed.inverse[at] ? 1 : -1;
}

/// Counts of pairs of neighbours, along rows and along columns.
struct Pairs {
  std::array<std::int64_t, 2> all{}, on_one_side{};

  Pairs& operator+=(const Pairs& other) {
    for (const int direction : {0, 1}) {
      all[direction] += other.all[direction];
      on_one_side[direction] += other.on_one_side[direction];
    }
    return *this;
  }
  bool areFree(int direction) const {
    const auto of_all = static_cast<double>(all[direction]), of_one_side = static_cast<double>(on_one_side[direction]);
    const double by_chance = std::sqrt(of_all);  // two standard deviations
    return of_all > 0 && of_one_side >= least_on_one_side * of_all - by_chance &&
           of_one_side <= most_on_one_side * of_all + by_chance;
  }
};

}  // namespace

bool changesSidesFreely(const PixelGrid& grid, const PointsView& points, const SmoothedRanges& smoothed,
                        const RangeNoise& noise, const Workers& workers) {
  const std::int64_t end = std::ssize(grid.rank) - grid.columns;
  const std::int64_t stride = sampleStride(end, tried_pixels, grid.columns);
  // relative variance of each sample
  RawBuffer<double> variance(static_cast<std::size_t>((end + stride - 1) / stride));
  const auto forSamples = [&](const auto& visit) {
    workers.forBlocks("windows", std::ssize(variance), usual_block, visit);
  };
  forSamples([&](std::int64_t first, std::int64_t last, int) {
    for (std::int64_t i = first; i < last; ++i) {
      const std::ptrdiff_t at = smoothed.atPixel(grid, i * stride);
      variance[i] = smoothed.variance[at] / std::pow(noise.atInverse(smoothed.inverse[at]), 2);
    }
  });
  Buffer<double> variances;
  variances.reserve(variance.size());
  std::copy_if(variance.begin(), variance.end(), std::back_inserter(variances), [](double of) { return of > 0; });
  if (variances.empty()) return false;
  const double most_variance = quantileOf(variances, tested_share) * equal_variances;

  Buffer<Pairs> pairs_of(workers.count());
  forSamples([&](std::int64_t first, std::int64_t last, int worker) {
    Pairs here;
    for (std::int64_t i = first; i < last; ++i) {
      if (!(variance[i] > 0 && variance[i] <= most_variance)) continue;
      const int side = sideOf(grid, points, smoothed, i * stride);
      for (const int direction : {0, 1}) {
        const int next = sideOf(grid, points, smoothed, i * stride + (direction == 0 ? 1 : grid.columns));
        here.all[direction] += next != 0 ? 1 : 0;
        here.on_one_side[direction] += next == side ? 1 : 0;
      }
    }
    pairs_of[worker] += here;
  });
  Pairs pairs;
  for (const Pairs& part : pairs_of) pairs += part;
  return pairs.areFree(0) && pairs.areFree(1);
}

}  // namespace tufted
