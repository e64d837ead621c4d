#include "depth_image/depth_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

#include "base/buffer.h"

namespace tufted {
namespace {

/// Number of pixels at which noise is measured; more give the same result.
constexpr std::int64_t noise_samples = 20000;
/// A relative change of the inverse depth between two pixels above this is a jump, which tells nothing about noise.
constexpr double jump = 0.04;
/// A change of the inverse depth below this many standard deviations of the noise is no jump in any case: far walls
/// have noise of 5 %.
constexpr double likely_jump = 6;
/// The first estimate takes the smallest 3/4 of all fourth differences, as fewer than 1/4 are at edges, the second the
/// smallest 9/10 of those without a jump; with 0.75 coarse depths would be taken for exact.
constexpr double kept_at_first = 0.75, kept = 0.9;
/// The mean square of the smallest 3/4, and 9/10, of normal numbers.
constexpr double spread_at_first = 0.37, spread = 0.62;
/// The variance of a fourth difference: the sum of the squares of 1, 4, 6, 4 and 1.
constexpr double sum_of_squares = 70;

// How noise depends on the inverse depth, by groups with similar inverse depths.

/// Rows of five pixels per group at least; the noise of the group is then known to a tenth.
constexpr std::ptrdiff_t least_in_group = 200;
/// With fewer groups no law is fitted: two agree with any.
constexpr std::size_t least_groups = 3;
/// If noise grows with a lower power of the inverse depth, it counts as constant. The power is 0 for disparities, up to
/// 0.4 for real cameras, 1 for relative noise, 2 for timed light.
constexpr double least_power = 0.6;
/// If the fitted law misses the noise of the groups by more than this, relatively, it is not used: right ones miss it
/// by less than 0.03, coarse depths by 0.35 and more. A wall in steps, taken for timed light, has 18 % too much area.
constexpr double max_relative_misfit = 0.2;

// Coarse depths with steps farther than five pixels apart.

/// In a row of five pixels around a step the other changes differ by at most this share of the step; at a crease by
/// more.
constexpr double alike_changes = 0.3;
/// The values between steps are exact but for rounding if the other changes differ by at most this share of the step:
/// rays 0.01 rad apart make 0.019.
constexpr double same = 0.02;
/// Depths count as rounded to steps if at least this share of the rows with a step stays below `same`; slats of a
/// centimetre, seen with noise of 0.2 mm, have 0.15.
constexpr double least_same = 0.7;
/// Depths count as rounded to steps if this share of all rows of five pixels has a step: coarse walls and floors have
/// 0.05 to 0.06, real images 0.002 to 0.006.
constexpr double least_steps = 0.01;
/// Steps are of one size if their interquartile range is at most this share of their median; for coarse depths it is
/// 0.08.
constexpr double most_spread = 0.25;

/// Inverse depths of five pixels in a row.
using Five = std::array<double, 5>;

/// Five inverse depths along the row, and five along the column, of sampled pixels. The first of five is NaN if a pixel
/// has no point.
RawBuffer<Five> takeFives(const PixelGrid& grid, const PointsView& points, const Workers& workers) {
  const auto inverseDepth = [&](std::int64_t pixel) {
    const int p = grid.rank[pixel];
    return p < 0 ? unknown : 1 / grid.depthOf(points.row(p));
  };
  const std::int64_t pixels = std::ssize(grid.rank), stride = sampleStride(pixels, noise_samples, grid.columns);
  const std::int64_t first = 2 * std::int64_t{grid.columns},
                     count = std::max<std::int64_t>(0, (pixels - 2 * first + stride - 1) / stride);
  // On rings only rows are used, because points of a column differ in azimuth.
  const auto isTold = [&grid](std::int64_t pixel, int direction) {
    if (!grid.goes_round) return true;
    return direction == 0 && grid.isHome(static_cast<int>(pixel % grid.columns));
  };
  RawBuffer<Five> fives(static_cast<std::size_t>(2 * count));
  workers.forBlocks("windows", count, usual_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t i = begin; i < end; ++i) {
      const std::int64_t pixel = first + i * stride;
      for (const int direction : {0, 1}) {
        const std::int64_t side = direction == 0 ? 1 : grid.columns;
        const bool is_told = isTold(pixel, direction);
        Five& w = fives[2 * i + direction];
        for (int k = 0; k < 5; ++k) w[k] = is_told ? inverseDepth(pixel + (k - 2) * side) : unknown;
        if (!std::isfinite(w[0] + w[1] + w[2] + w[3] + w[4])) w[0] = unknown;
      }
    }
  });
  return fives;
}

/// The standard deviation of the noise by the smallest fourth differences of rows without a jump.
/// @param least smaller changes of the inverse depth are no jumps
/// @param share of the differences that is used
/// @param mean_square of the smallest `share` of normal numbers
double noiseOf(std::span<const Five> fives, double least, double share, double mean_square) {
  Buffer<double> squares;
  squares.reserve(fives.size());
  for (const Five& w : fives) {
    if (std::isnan(w[0])) continue;
    const auto jumps = [least](double a, double b) { return std::abs(a - b) > std::max(least, jump * std::min(a, b)); };
    if (std::adjacent_find(w.begin(), w.end(), jumps) != w.end()) continue;
    const double difference = w[0] - 4 * w[1] + 6 * w[2] - 4 * w[3] + w[4];
    squares.push_back(difference * difference);
  }
  const auto count = static_cast<std::ptrdiff_t>(share * static_cast<double>(squares.size()));
  if (count == 0) return 0;
  std::nth_element(squares.begin(), squares.begin() + count, squares.end());
  const double sum = std::accumulate(squares.begin(), squares.begin() + count, 0.0);
  return std::sqrt(sum / static_cast<double>(count) / mean_square / sum_of_squares);
}

/// noiseOf() of all rows first, then of those without changes that the noise found does not explain.
double noiseOf(std::span<const Five> fives) {
  const double at_first = noiseOf(fives, std::numeric_limits<double>::infinity(), kept_at_first, spread_at_first);
  return noiseOf(fives, likely_jump * at_first, kept, spread);
}

/// Rows of five pixels by half octaves of their inverse depth.
struct Groups {
  RawBuffer<Five> fives;
  Buffer<std::size_t> begin;  ///< first row of each group, and the end

  std::size_t size() const { return begin.size() - 1; }
  std::span<const Five> operator[](std::size_t i) const { return {fives.data() + begin[i], begin[i + 1] - begin[i]}; }
};

int halfOctaveOf(double inverse_depth) {
  int octave = 0;
  return std::frexp(inverse_depth, &octave) < std::numbers::sqrt2 / 2 ? 2 * octave - 1 : 2 * octave;
}

Groups groupsOf(const RawBuffer<Five>& fives) {
  constexpr int none = std::numeric_limits<int>::max();
  Buffer<int> group_of(fives.size(), none);
  int first = none, last = -none;
  for (std::size_t i = 0; i < fives.size(); ++i) {
    if (std::isnan(fives[i][0])) continue;
    group_of[i] = halfOctaveOf(fives[i][2]);
    first = std::min(first, group_of[i]);
    last = std::max(last, group_of[i]);
  }
  Groups groups;
  groups.begin.assign(first > last ? 1 : static_cast<std::size_t>(last - first) + 2, 0);
  for (const int group : group_of)
    if (group != none) ++groups.begin[group - first + 1];
  std::partial_sum(groups.begin.begin(), groups.begin.end(), groups.begin.begin());
  groups.fives.resize(groups.begin.back());
  Buffer<std::size_t> next = groups.begin;
  for (std::size_t i = 0; i < fives.size(); ++i)
    if (group_of[i] != none) groups.fives[next[group_of[i] - first]++] = fives[i];
  return groups;
}

struct NoiseAtDepth {
  double inverse;  ///< mean inverse depth
  double noise;
  double weight;
};

NoiseAtDepth levelOf(std::span<const Five> group) {
  double sum = 0;
  for (const Five& w : group) sum += w[2];
  const auto count = static_cast<double>(group.size());
  return {sum / count, noiseOf(group), count};
}

/// The power of the inverse depth with which noise grows: the slope of a line through their logarithms.
double powerOf(const Buffer<NoiseAtDepth>& levels) {
  double all = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const NoiseAtDepth& level : levels) {
    const double a = std::log(level.inverse), b = std::log(level.noise);
    all += level.weight;
    x += level.weight * a;
    y += level.weight * b;
    xx += level.weight * a * a;
    xy += level.weight * a * b;
  }
  return (all * xy - x * y) / (all * xx - x * x);
}

/// The sum of both laws that fits the levels best, by relative errors; nothing if it misses them.
std::optional<RangeNoise> fitOf(const Buffer<NoiseAtDepth>& levels) {
  double aa = 0, ab = 0, bb = 0, a = 0, b = 0;
  for (const NoiseAtDepth& level : levels) {
    const double of_inverse = 1 / level.noise, of_depth = level.inverse * level.inverse / level.noise;
    aa += level.weight * of_inverse * of_inverse;
    ab += level.weight * of_inverse * of_depth;
    bb += level.weight * of_depth * of_depth;
    a += level.weight * of_inverse;
    b += level.weight * of_depth;
  }
  const double determinant = aa * bb - ab * ab;
  RangeNoise noise{(bb * a - ab * b) / determinant, (aa * b - ab * a) / determinant};
  if (noise.of_inverse < 0) noise = {0, b / bb};
  double misfit = 0, weight = 0;
  for (const NoiseAtDepth& level : levels) {
    misfit += level.weight * std::pow(noise.atInverse(level.inverse) / level.noise - 1, 2);
    weight += level.weight;
  }
  if (!(noise.of_depth >= 0 && misfit <= max_relative_misfit * max_relative_misfit * weight)) return std::nullopt;
  return noise;
}

/// The step in the middle of a row of five pixels.
struct MiddleStep {
  double size;
  double unlike;  ///< how much the other changes differ: small except at creases, and where noise is not small
};

MiddleStep middleStep(const Five& w) {
  const double before = w[1] - w[0], after = w[4] - w[3], first = w[2] - w[1], second = w[3] - w[2];
  const double slope = (before + after) / 2, a = std::abs(first - slope), b = std::abs(second - slope);
  return {std::max(a, b), std::max(std::abs(before - after), std::min(a, b))};
}

/// The standard deviation of rounding to steps of one size; 0 if there are no such steps. noiseOf() misses steps that
/// are far apart, because the smallest differences all lie between them.
double roundingOf(std::span<const Five> fives, double noise) {
  Buffer<double> steps;
  double count = 0, same_count = 0;
  for (const Five& w : fives) {
    if (std::isnan(w[0])) continue;
    ++count;
    const MiddleStep step = middleStep(w);
    if (!(step.size > likely_jump * noise && step.size <= jump * w[2] && step.unlike <= alike_changes * step.size))
      continue;
    steps.push_back(step.size);
    same_count += step.unlike <= same * step.size ? 1 : 0;
  }
  const std::ptrdiff_t size = std::ssize(steps);
  if (size == 0 || static_cast<double>(size) < least_steps * count) return 0;
  if (same_count < least_same * static_cast<double>(size)) return 0;
  std::sort(steps.begin(), steps.end());
  const double median = steps[size / 2];
  if (steps[3 * size / 4] - steps[size / 4] > most_spread * median) return 0;
  return median / std::sqrt(12.0);
}

}  // namespace

RangeNoise rangeNoise(const PixelGrid& grid, const PointsView& points, const Workers& workers) {
  const RawBuffer<Five> fives = takeFives(grid, points, workers);
  const Groups groups = groupsOf(fives);
  double of_inverse = 0;
  Buffer<NoiseAtDepth> levels(groups.size(), NoiseAtDepth{});
  // The noise of all rows first, because it takes as long as all groups together.
  workers.forBlocks("windows", std::ssize(levels) + 1, 1, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t i = begin; i < end; ++i) {
      if (i == 0) {
        of_inverse = noiseOf(fives);
      } else if (std::ssize(groups[i - 1]) >= least_in_group) {
        levels[i - 1] = levelOf(groups[i - 1]);
      }
    }
  });
  const double rounding = roundingOf(fives, of_inverse);
  if (rounding > 0) return {std::max(of_inverse, rounding), 0};
  std::erase_if(levels, [](const NoiseAtDepth& level) { return level.weight == 0; });
  const auto isKnown = [](const NoiseAtDepth& level) { return level.noise > 0; };
  if (levels.size() >= least_groups && std::all_of(levels.begin(), levels.end(), isKnown) &&
      powerOf(levels) > least_power)
    if (const auto noise = fitOf(levels)) return *noise;
  return {of_inverse, 0};
}

}  // namespace tufted
