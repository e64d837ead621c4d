#include "denoise/window_choice.h"

#include <algorithm>
#include <cmath>

#include "denoise/pooling.h"

namespace tufted {
namespace {

constexpr std::int64_t block_size = 1024;
constexpr double shift = 2.5;     // the estimate may shift by so many of its own variances; 1 is noise alone
constexpr double growth = 2;      // of the residuals' variance by the noise's
constexpr double own_growth = 4;  // of the residuals' variance around the point alone, by the noise's
constexpr double own_height = 5;  // sigmas of the point alone from the fit
constexpr double relative = 1.6;  // of the residuals' variance by that of the smallest window
/// Of the spacing: no wider window once the remaining error is that small, by window.
constexpr std::array<double, Windows::sizes> enough = {0, 0, 0.02, 0.05};

const Windows::Pool& poolOf(const Windows& windows, int p, int window) {
  return window < 2 ? windows.near[p] : window == 2 ? windows.middle[p] : windows.far[p];
}

double finiteOrZero(double value) {
  return std::isfinite(value) ? value : 0;
}

}  // namespace

WindowChoice chooseWindows(const Windows& windows, const NoiseLevel& noise, const Workers& workers) {
  WindowChoice choice;
  choice.window.assign(windows.base.size(), -1);
  choice.biased.assign(windows.base.size(), 0);
  workers.forBlocks("noise", windows.size(), block_size, [&](std::int64_t begin, std::int64_t end, int) {
    for (int p = static_cast<int>(begin); p < end; ++p) {
      if (noise.noisy[p] == 0 || windows.fits[p][1].leverage > most_leverage) continue;
      const double variance = noise.variance[p];
      for (int k = 0; k < Windows::sizes; ++k) {
        const auto mean = [&](const auto& value) { return pooledMean(p, poolOf(windows, p, k), value); };
        const auto height = [&](int q, int window) { return window < 0 ? 0 : windows.fits[q][window].height; };
        const auto leverage = [&](int q, int window) { return window < 0 ? 1 : windows.fits[q][window].leverage; };
        if (enough[k] > 0) {
          const double left = variance * pooledMean(p, windows.near[p], [&](int q) { return leverage(q, k - 1); });
          const double bound = enough[k] * windows.spacing(p);
          if (left < bound * bound) break;
        }
        const double shifted = mean([&](int q) {
          if (noise.outlier[q] != 0) return 0.0;
          const double d = height(q, k) - height(q, k - 1);
          return d * d;
        });
        const double expected =
            variance * std::max(1e-12, mean([&](int q) { return leverage(q, k - 1) - leverage(q, k); }));
        const double residual = mean([&](int q) { return finiteOrZero(windows.fits[q][k].variance); });
        const double smallest = mean([&](int q) { return finiteOrZero(windows.fits[q][0].variance); });
        const WindowFit& own = windows.fits[p][k];
        if (!(shifted < shift * expected && residual < growth * variance && residual < relative * smallest &&
              own.variance < own_growth * variance && own.height * own.height < own_height * own_height * variance)) {
          choice.biased[p] = 1;
          break;
        }
        choice.window[p] = static_cast<std::int8_t>(k);
      }
    }
  });
  return choice;
}

}  // namespace tufted
