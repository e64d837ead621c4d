#include "denoise/shared_windows.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "denoise/crease_model.h"
#include "denoise/pooling.h"

namespace tufted {
namespace {

constexpr std::int8_t least_shared = 2;  // of Windows::fits: smaller windows hold too few points to be shared
constexpr double grown = 1.1;            // of the residuals' variance from the base window to the next: noise 1
// The residuals' variance grows by so much from each window to the next where noise is alike in neighbouring points.
constexpr double least_growth = 1.09, most_growth = 1.7;
constexpr double most_acceleration = 1.15;  // of that growth by the one before
constexpr double least_alike = 0.5;         // of the windows around: of noise that is alike in neighbouring points
constexpr double without_crease = 0.85;     // cosine between the normals of windows around

/// Whether normals in the widest window around w, or near it, differ from that of w by more than the angle of a cosine.
bool isBent(const Windows& windows, const NoiseLevel& noise, int w, double cosine) {
  return std::ranges::any_of(windows.far[w], [&](int q) {
    return noise.outlier[q] == 0 && !(std::abs(windows.normal.row(q).dot(windows.normal.row(w))) > cosine);
  });
}

/// Whether the residuals grow from the base window to the next.
bool isGrowing(const Windows& windows, int w) {
  const auto mean = [&](int size) {
    return pooledMean(w, windows.near[w], [&](int q) { return residualOf(windows.fits[q][size]); });
  };
  return !(mean(least_shared) < grown * mean(Windows::base_size));
}

/// Variances of residuals, of the windows of neighbours.
using Residuals = std::array<double, Windows::searched>;

/// The sum of of(q) over w and the windows in and around the widest one.
template <class Of>
Residuals sumAround(const Windows& windows, int w, const Of& of) {
  Residuals sum{};
  forEachPooled(w, windows.far[w], [&](int q, int times) {
    const Residuals each = of(q);
    for (std::size_t size = 0; size < sum.size(); ++size) sum[size] += times * each[size];
  });
  return sum;
}

/// Whether residuals grow a little and steadily, from window to window twice as large. Those of white noise stay the
/// same, those of a smooth surface grow faster each time, up to eight times as fast, until a window holds a whole wave.
bool growsSteadily(const Residuals& residuals) {
  const double first = residuals[1] / residuals[0], second = residuals[2] / residuals[1];
  const double third = residuals[3] / residuals[2];
  return std::min(first, second) > least_growth && second < most_acceleration * first && third > second &&
         third < most_growth;
}

/// The windows in which noise is alike in neighbouring points, as that of cameras is: what looks like a bend in them is
/// the noise.
Buffer<std::uint8_t> findAlikeNoise(const Windows& windows, const Workers& workers) {
  const auto size = windows.base.size();
  RawBuffer<Residuals> around(size);
  forEachPoint(windows, workers, [&](int w) {
    around[w] = sumAround(windows, w, [&](int q) {
      Residuals own;
      for (std::size_t i = 0; i < own.size(); ++i) own[i] = residualOf(windows.fits[q][i]);
      return own;
    });
  });
  Buffer<std::uint8_t> is_steady(size), is_alike(size);
  forEachPoint(windows, workers, [&](int w) {
    is_steady[w] = growsSteadily(sumAround(windows, w, [&](int q) { return around[q]; })) ? 1 : 0;
  });
  forEachPoint(windows, workers, [&](int w) {
    is_alike[w] = pooledMean(w, windows.far[w], [&](int q) { return is_steady[q]; }) >= least_alike ? 1 : 0;
  });
  return is_alike;
}

}  // namespace

Buffer<std::int8_t> sharedWindows(const Windows& windows, const NoiseLevel& noise, const WindowChoice& choice,
                                  const Workers& workers) {
  Buffer<std::int8_t> shared(windows.base.size());
  Buffer<std::uint8_t> bends(windows.base.size(), 0);
  forEachPoint(windows, workers, [&](int w) {
    const std::int8_t chosen = choice.window[w];
    shared[w] = -1;
    if (windows.split[w] != 0 || chosen < Windows::base_size) return;
    if (chosen >= Windows::searched - 1 || (choice.biased[w] == 0 && chosen >= least_shared)) {
      shared[w] = chosen;
    } else if (choice.biased[w] != 0 && windows.base[w] == Windows::first_base &&
               !isBent(windows, noise, w, CreaseModel::same_face)) {
      bends[w] = 1;
    }
  });
  if (std::ranges::find(bends, 1) == bends.end()) return shared;
  const Buffer<std::uint8_t> is_alike = findAlikeNoise(windows, workers);
  forEachPoint(windows, workers, [&](int w) {
    if (bends[w] == 0) return;
    if (is_alike[w] != 0 && !isBent(windows, noise, w, without_crease))
      shared[w] = static_cast<std::int8_t>(choice.window[w] + 1);
    else
      shared[w] = choice.window[w] < least_shared || isGrowing(windows, w) ? Windows::base_size : least_shared;
  });
  return shared;
}

}  // namespace tufted
