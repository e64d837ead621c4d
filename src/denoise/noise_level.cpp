#include "denoise/noise_level.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace tufted {
namespace {

/// Noise below this share of the spacing does nothing to L, and the points stay.
constexpr double least_noise = 0.01;
/// If fewer fits of a pool are valid, their mean error is unknown.
constexpr int least_fits = 9;
/// A window whose smallest variance exceeds this share of the middle one is narrower than three sigmas of noise, and
/// its plane is not reliable.
constexpr double thick = 0.15;
/// The last size whose errors can be compared with those of the next.
constexpr int widest = sizes - 2;
/// A thick window holds noise if the thickness of one with four times as many points is less than this share of its
/// own: 1/4 if noise makes it thick, 1 if shape does. With 0.55 noise of 1.4 spacings on a sphere is missed.
constexpr double thinner = 0.8;
/// Errors are noise if they grow from one size of fits to the next by less than `white_growth` (detail: 2.6 and more),
/// by less than `rough_growth` if they are as large as `rough` spacings, and not at all if they are as large as
/// `too_rough` times that, as in trees.
constexpr double white_growth = 1.3, rough_growth = 2.3, rough = 0.4, too_rough = 2;
/// Errors are noise only if their median is at least this share of their mean: white noise has 0.45, a pool beside a
/// crease less. Below 0.2 points of an exact cube move.
constexpr double least_even = 0.25;
/// Approximate factor by which errors of detail grow from size to size.
constexpr double detail_growth = 3;
/// The variance of the noise is at least this share of the mean error. With 0.5 the results are the same.
constexpr double least_noisy = 0.2;
/// There is noise at a centre if this share of its pool has white errors. From 0.3 to 0.5 the results are the same.
constexpr double share = 0.4;
/// The share of the neighbours within half the distance is 1/2 along a curve, 1/4 on a surface, 1/8 in a volume: above
/// the first bound it is a curve, below the second a volume. With 0.155 points beside the faces of volumes moved.
constexpr double curve_share = 0.41, volume_share = 0.185;
/// In a volume the smallest variance must also exceed this share of the middle one. With 0.45 thin parts of noisy
/// shapes were taken for volumes.
constexpr double volume_thickness = 0.5;
/// If more than this share of the pool has no surface, the points around a centre have none. With 0.25 two of 1,000
/// points in a cube move.
constexpr double none_share = 0.2;
/// Errors above this many times the variance of the noise are bias; white noise reaches it by chance. With 1.2 and 1.5
/// the results are the same.
constexpr double white_error = 1.3;
/// If residuals exceed the noise by more than this many standard deviations there is a crease, and a smaller fit is
/// taken. With 2 a cube with 1 % noise has errors of 1.4e-2 instead of 1.2e-2.
constexpr double by_chance = 1;
constexpr double unknown_error = std::numeric_limits<double>::infinity();

/// Change of the height of the surface over a centre from the next smaller size to this one.
double change(const LocalSurface& surface, int size) {
  const SurfaceFit &wide = surface.fit[size], &narrow = surface.fit[size - 1];
  if (!narrow.isValid()) return 0;
  double cosine = 0;
  for (int axis = 0; axis < 3; ++axis) cosine += double{wide.normal[axis]} * narrow.normal[axis];
  return wide.height() - narrow.height() * cosine;
}

/// Statistics over the pool of a centre.
class Pool {
 public:
  /// All arguments are borrowed.
  Pool(const SurfaceFits& fits, int center) : fits_(fits), pool_(fits.poolOf(center)) {}

  /// The mean of value(surface) over valid fits of a size; unknown if these are fewer than `least_fits`.
  template <class Value>
  double mean(int size, const Value& value) const {
    double sum = 0;
    int count = 0;
    for (const int c : pool_) {
      const LocalSurface& surface = fits_.surface[c];
      if (!surface.fit[size].isValid()) continue;
      sum += value(surface);
      ++count;
    }
    return count < least_fits ? unknown_error : sum / count;
  }
  /// The mean squared error of the predictions by fits of a size.
  double error(int size) const {
    return mean(size, [&](const LocalSurface& surface) { return surface.fit[size].squaredError(); });
  }
  double leverage(int size) const {
    return mean(size, [&](const LocalSurface& surface) { return surface.fit[size].leverage; });
  }
  double squaredChange(int size) const {
    return mean(size, [&](const LocalSurface& surface) {
      const double by = change(surface, size);
      return by * by;
    });
  }
  double thickness(int size) const {
    return median([&](int c) { return fits_.surface[c].fit[size].thickness; });
  }
  template <class Test>
  std::ptrdiff_t count(const Test& test) const {
    return std::ranges::count_if(pool_, test);
  }
  double innerShare() const {
    double sum = 0;
    for (const int c : pool_) sum += fits_.surface[c].inner_share;
    return sum / static_cast<double>(pool_.size());
  }
  /// The median of the values that are not negative; -1 if there are fewer than `least`.
  template <class Value>
  double median(const Value& value, double least = 0) const {
    std::array<double, SurfaceFits::most_pooled> values;
    auto end = values.begin();
    for (const int c : pool_) {
      *end = value(c);
      if (*end >= 0) ++end;
    }
    const auto count = end - values.begin();
    if (count == 0 || static_cast<double>(count) < least) return -1;
    std::nth_element(values.begin(), values.begin() + count / 2, end);
    return values[count / 2];
  }

 private:
  const SurfaceFits& fits_;
  std::span<const int> pool_;
};

/// Errors of predictions around a centre (section 27 of docs/algorithm.md, steps 2 to 4).
struct Predictions {
  int size = 0;          ///< the base size, whose windows are wider than the noise is thick
  double error = 0;      ///< mean squared error at that size
  double median = 0;     ///< median squared error at that size
  double wider = 0;      ///< mean squared error at the next size
  double roughness = 0;  ///< `error` in units of (`rough` spacings)^2
  bool no_surface = false;

  Predictions(const SurfaceFits& fits, int center) {
    const Pool pool(fits, center);
    double thickness = pool.thickness(0);
    while (size < widest && thickness > thick && pool.thickness(size + 2) < thinner * thickness)
      thickness = pool.thickness(++size);
    const double inner = pool.innerShare(), spacing = fits.surface[center].spacing;
    no_surface = inner > curve_share || (inner < volume_share && thickness > volume_thickness);
    error = pool.error(size);
    median = pool.median([&](int c) { return fits.surface[c].fit[size].squaredError(); });
    wider = pool.error(size + 1);
    roughness = error / (rough * rough * spacing * spacing);
  }

  /// The variance of the noise if errors are white, else -1.
  double whiteVariance() const {
    const double rough_share = std::min(1.0, roughness * roughness);
    const double growth =
        roughness > too_rough * too_rough ? 1 : white_growth + (rough_growth - white_growth) * rough_share;
    if (!(wider < growth * error) || !(median > least_even * error)) return -1;
    return std::max(least_noisy * error, error - std::max(0.0, wider - error) / (detail_growth - 1));
  }
};

/// The size with the least expected squared error (step 5): remaining noise plus the bias that errors beyond noise
/// show. -1 if points that stay have less.
int bestSize(const SurfaceFits& fits, int center, int smallest, double variance) {
  const Pool pool(fits, center);
  double least = variance, bias = 0, narrower = 1;
  int best = -1;
  for (int size = smallest; size < sizes; ++size) {
    const double error = pool.error(size);
    if (!std::isfinite(error)) break;
    const double leverage = pool.leverage(size);
    if (size == smallest)
      bias = (error - variance) * (1 - leverage);
    else
      bias = std::max({bias, pool.squaredChange(size) - variance * std::max(0.0, narrower - leverage),
                       (error - white_error * variance) * (1 - leverage)});
    bias = std::max(bias, 0.0);
    if (bias + leverage * variance < least) {
      least = bias + leverage * variance;
      best = size;
    }
    narrower = leverage;
  }
  return best;
}

double leastVariance(const SurfaceFits& fits, int center) {
  const double least = least_noise * fits.surface[center].spacing;
  return least * least;
}

template <class Visit>
void forEachCenter(const SurfaceFits& fits, const Workers& workers, const Visit& visit) {
  workers.forBlocks("noise", fits.count(), star_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (auto c = static_cast<int>(begin); c < end; ++c) visit(c);
  });
}

}  // namespace

double excessOf(const SurfaceFit& fit, int size, double variance) {
  return (fit.variance / variance - 1) * std::sqrt((fit_sizes[size] - 5) / 2.0);
}

RawBuffer<LocalNoise> findNoise(const SurfaceFits& fits, const Workers& workers) {
  const auto count = static_cast<std::size_t>(fits.count());
  RawBuffer<LocalNoise> noise(count);
  RawBuffer<double> white(count);
  RawBuffer<std::uint8_t> smallest(count), is_none(count);
  forEachCenter(fits, workers, [&](int c) {
    const Predictions predictions(fits, c);
    smallest[c] = static_cast<std::uint8_t>(predictions.size);
    is_none[c] = predictions.no_surface ? 1 : 0;
    const bool has_noise = !predictions.no_surface && predictions.error > leastVariance(fits, c);
    white[c] = has_noise ? predictions.whiteVariance() : -1;
  });
  forEachCenter(fits, workers, [&](int c) {
    noise[c] = {};
    const Pool pool(fits, c);
    noise[c].no_surface = pool.count([&](int q) { return is_none[q] != 0; }) > none_share * fits.pool_size;
    if (noise[c].no_surface) return;
    const double variance = pool.median([&](int q) { return white[q]; }, share * fits.pool_size);
    if (!(variance > leastVariance(fits, c))) return;
    LocalNoise& around = noise[c];
    around.variance = variance;
    around.size = bestSize(fits, c, smallest[c], variance);
    while (around.size > smallest[c] && excessOf(fits.surface[c].fit[around.size], around.size, variance) > by_chance)
      --around.size;
  });
  return noise;
}

Buffer<std::uint8_t> whereNoiseMayBe(const PointsView& points, const PointBuffer& normals, const NeighborSearch& search,
                                     const Workers& workers) {
  Buffer<std::uint8_t> may_be(static_cast<std::size_t>(points.rows()), 1);
  Centers few = fewCenters(points, workers);
  if (std::ssize(few.rank) < SurfaceFits::most_pooled) return may_be;
  const SurfaceFits fits = fitSurfaces(points, normals, search, std::move(few), workers);
  RawBuffer<std::uint8_t> is_sure(static_cast<std::size_t>(fits.count()));
  forEachCenter(fits, workers, [&](int c) {
    const Predictions predictions(fits, c);
    const bool has_noise =
        predictions.error > leastVariance(fits, c) && !(predictions.wider > rough_growth * predictions.error);
    is_sure[c] = !predictions.no_surface && !has_noise ? 1 : 0;
  });
  workers.forBlocks("noise", points.rows(), usual_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t p = begin; p < end; ++p) may_be[p] = is_sure[fits.centers.near[p]] != 0 ? 0 : 1;
  });
  return may_be;
}

}  // namespace tufted
