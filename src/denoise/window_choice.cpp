#include "denoise/window_choice.h"

#include <algorithm>
#include <cmath>

#include "denoise/pooling.h"

namespace tufted {
namespace {

constexpr double shift = 2.5;     // the estimate may shift by so many of its own variances; 1 is noise alone
constexpr double growth = 2;      // of the residuals' variance by the noise's
constexpr double own_growth = 4;  // of the residuals' variance around the point alone, by the noise's
constexpr double own_height = 5;  // sigmas of the point alone from the fit
constexpr double relative = 1.6;  // of the residuals' variance by that of the smallest window
/// Of the spacing: no wider window once the remaining error is that small, by window.
constexpr std::array<double, Windows::searched> enough = {0, 0, 0.02, 0.05};

/// The windows whose fits are averaged to judge a window. Around points alone, settled ones have no fits in the widest
/// windows: the surface is smooth there.
Windows::Pool poolOf(const Windows& windows, int p, int window) {
  if (windows.stride > 1) return windows.far[p];  // else there are few
  if (window < Windows::searched - 1) return window < 2 ? windows.near[p] : windows.middle[p];
  Windows::Pool found, pool;
  const auto end =
      std::ranges::copy_if(windows.far[p], found.begin(), [&](int q) { return windows.fits[q][window].count > 0; }).out;
  const auto count = static_cast<std::size_t>(end - found.begin());
  if (count == 0) found[0] = p;
  for (std::size_t i = 0; i < pool.size(); ++i) pool[i] = found[i * count / pool.size()];
  return pool;
}

/// What speaks for a window around one point, and against it.
class Choice {
 public:
  Choice(const Windows& windows, const NoiseLevel& noise, int p)
      : windows_(windows), noise_(noise), p_(p), variance_(noise.variance[p]) {}

  /// Whether what is left of the noise with the window before is so little that a wider one gains nothing.
  bool isEnough(int window) const {
    if (!(enough[window] > 0)) return false;
    const double left = variance_ * pooledMean(p_, windows_.near[p_], [&](int q) { return leverage(q, window - 1); });
    const double bound = enough[window] * windows_.spacing(p_);
    return left < bound * bound;
  }

  /// Whether the surface is a quadratic there, as far as the noise lets one see.
  bool isFlat(int window) const {
    double shifted = 0, leverages = 0, residual = 0, smallest = 0;  // sums over the pool
    forEachPooled(p_, poolOf(windows_, p_, window), [&](int q, int times) {
      const WindowFit& fit = windows_.fits[q][window];
      const double d = noise_.outlier[q] != 0 ? 0 : fit.height - height(q, window - 1);
      shifted += times * (d * d);
      leverages += times * (leverage(q, window - 1) - fit.leverage);
      residual += times * residualOf(fit);
      smallest += times * residualOf(windows_.fits[q][0]);
    });
    const double count = Windows::pooled + 1;
    const double by_noise = variance_ * std::max(0.0, leverages / count);
    const WindowFit& own = windows_.fits[p_][window];
    return shifted / count < shift * by_noise && residual / count < growth * variance_ &&
           residual < relative * smallest && own.variance < own_growth * variance_ &&
           own.height * own.height < own_height * own_height * variance_;
  }

 private:
  /// Of no window: the point itself, as it is.
  double height(int q, int window) const { return window < 0 ? 0 : windows_.fits[q][window].height; }
  double leverage(int q, int window) const { return window < 0 ? 1 : windows_.fits[q][window].leverage; }

  const Windows& windows_;
  const NoiseLevel& noise_;
  int p_;
  double variance_;
};

}  // namespace

WindowChoice chooseWindows(const Windows& windows, const NoiseLevel& noise, std::span<const int> which,
                           const Workers& workers) {
  WindowChoice choice;
  choice.window.assign(windows.base.size(), -1);
  choice.biased.assign(windows.base.size(), 0);
  const bool is_own = windows.stride == 1;  // windows that points share cost no more when they are wide
  workers.forBlocks("noise", std::ssize(which), star_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (const int w : which.subspan(begin, end - begin)) {
      if (noise.noisy[w] == 0 || windows.fits[w][Windows::base_size].leverage > most_leverage) continue;
      const Choice of_w(windows, noise, w);
      for (int k = 0; k < windows.levels() && !(is_own && of_w.isEnough(k)); ++k) {
        if (!of_w.isFlat(k)) {
          choice.biased[w] = 1;
          break;
        }
        choice.window[w] = static_cast<std::int8_t>(k);
      }
    }
  });
  return choice;
}

}  // namespace tufted
