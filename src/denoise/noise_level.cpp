#include "denoise/noise_level.h"

#include <algorithm>
#include <cmath>

#include "denoise/neighbor_lists.h"
#include "denoise/pooling.h"

namespace tufted {
namespace {

constexpr int most_widenings = 3;
constexpr double thick = 0.25;            // smallest by middle variance: windows of less than four sigmas are widened
constexpr double still_thick = 0.6;       // a crease does not get thinner in a wider window, noise does
constexpr double share_to_widen = 0.002;  // of the points; fewer are left
/// Bounds of the share of a base window's points within half its radius: 1/2 along a curve, 1/4 on a surface and 1/8 in
/// a volume. Noisy scan lines have up to .40 and surfaces in thick noise down to .19, once their windows are widened.
constexpr double curve_share = 0.41, volume_share = 0.18;
/// The same where sheets were told apart, as in the layers of a lattice: two sheets 2 spacings apart have more.
constexpr double thin_volume_share = 0.155;
constexpr double chi_median = 0.94;      // median of chi squared by its degrees of freedom, of which there are 11
constexpr int low_rank = 3;              // of 33: a tenth
constexpr double low_correction = 1.12;  // of that low quantile of medians, to the variance
constexpr double alone = 1. / 3;         // of the neighbours, which are left where those of other surfaces are left out
constexpr int outlier_rounds = 4;
constexpr double outlier_growth = 2;  // of the residuals' variance by the noise's, around an outlier
constexpr double exact = 0.2;         // of the least noise's variance: residuals below are those of exact points
constexpr double exact_share = 0.1;   // of the points around
constexpr double noise_growth = 1.4;  // of the residuals' variance from window to window: noise 1, a crease 2 to 3
constexpr double sure_share = 0.15;   // of the points around

// A first look at the noise takes samples, which are windows around some points.
constexpr int sample_stride = 64, least_samples = 64, most_samples = 1000;
constexpr int widest_judged = 2;     // of Windows::fits, that with 64 neighbours
constexpr double sample_growth = 2;  // of residuals' variance from 16 to 64 neighbours: noise 1, a crease 4
constexpr double least_share = 0.05, most_exact = 0.5;  // of the samples like noise, of those around them exact
constexpr int samples_around = 16;                      // one after the other along the curve, next to each other

/// The median thickness around each point.
RawBuffer<double> thicknessAround(const Windows& windows, const Workers& workers) {
  RawBuffer<double> around(windows.base.size());
  forEachPoint(windows, workers, [&](int p) {
    const Windows::Pool& pool = windows.stride > 1 ? windows.far[p] : windows.near[p];
    around[p] = pooledMedian(p, pool, [&](int q) { return windows.thickness[q]; });
  });
  return around;
}

void makeWindows(const WindowFitter& fitter, std::span<const int> which, Windows& windows, NeighborLists& lists) {
  fitter.take(which, windows, &lists);
  fitter.spreadPools(which, lists, windows);
}

/// Doubles the base windows of some. Of windows around every so many points each stands for more of them then: it takes
/// the place of those beside it.
/// @param step how often they were doubled before
/// @param waits those that may be doubled; overwritten
/// @returns how many points are concerned
int widenOnce(const WindowFitter& fitter, int step, const RawBuffer<double>& around, Buffer<std::uint8_t>& waits,
              Windows& windows, NeighborLists& lists) {
  const int apart = windows.stride > 1 ? 2 << step : 1, n = windows.size();
  Buffer<int> which;
  for (int w = 0; w < n; w += apart) {
    const bool is_wider =
        waits[w] != 0 && (windows.line[w] != 0 || around[w] > thick) && 8 * windows.base[w] <= windows.pointOf(n) - 1;
    std::fill(waits.begin() + w, waits.begin() + std::min(w + apart, n), is_wider ? 1 : 0);
    if (is_wider) which.push_back(w);
  }
  if (static_cast<double>(which.size()) * apart < share_to_widen * n) return 0;
  for (const int w : which) windows.base[w] *= 2;
  makeWindows(fitter, which, windows, lists);
  for (const int w : which)
    for (int other = w + 1; other < std::min(w + apart, n); ++other) windows.copy(w, other);
  return static_cast<int>(which.size());
}

/// The share of the points of each base window, but the farthest, that lie within half its radius.
RawBuffer<double> innerShares(const WindowFitter& fitter, const NeighborLists& lists, const Workers& workers,
                              const Windows& windows) {
  RawBuffer<double> share(windows.base.size());
  forEachPoint(windows, workers, [&](int w) {
    const std::span<const int> list = lists.of(windows.copied(w));
    const auto base = std::min<std::size_t>(windows.base[w], list.size());
    const Eigen::RowVector3d middle = fitter.points().row(windows.pointOf(windows.copied(w)));
    const auto squareTo = [&](int p) { return (fitter.points().row(p) - middle).squaredNorm(); };
    share[w] = 0;
    if (base < 2) return;
    const double within = squareTo(list[base - 1]) / 4;
    for (const int p : list.first(base - 1)) share[w] += squareTo(p) <= within ? 1 : 0;
    share[w] /= static_cast<double>(base - 1);
  });
  return share;
}

/// Doubles base windows while the points in them are as thick as wide, or a line.
/// @returns NoiseLevel::no_surface
Buffer<std::uint8_t> widen(const WindowFitter& fitter, const Workers& workers, Windows& windows, NeighborLists& lists) {
  const int n = windows.size();
  RawBuffer<double> around = thicknessAround(windows, workers);
  const RawBuffer<double> first = around;
  Buffer<std::uint8_t> waits(windows.base.size(), 1), was_line(windows.base.size(), 0);
  for (int w = 0; w < n; ++w) {
    was_line[w] = windows.line[w];
    if (windows.split[w] != 0) waits[w] = 0;  // sheets would be taken for one that is thick
  }
  for (int step = 0; step < most_widenings; ++step) {
    if (widenOnce(fitter, step, around, waits, windows, lists) == 0) break;
    around = thicknessAround(windows, workers);
  }
  // What stays thick is a crease or a volume.
  const RawBuffer<double> inner = innerShares(fitter, lists, workers, windows);
  Buffer<std::uint8_t> is_none(windows.base.size(), 0);
  forEachPoint(windows, workers, [&](int w) {
    const double share = pooledMean(w, windows.near[w], [&](int q) { return inner[q]; });
    if (share > curve_share || share < (around[w] > thick ? volume_share : thin_volume_share)) is_none[w] = 1;
  });
  Buffer<int> back;
  for (int w = 0; w < n; ++w)
    if (is_none[w] == 0 && windows.base[w] > Windows::first_base && around[w] > thick &&
        around[w] > still_thick * first[w] && was_line[w] == 0)
      back.push_back(w);
  for (const int w : back) {
    windows.base[w] = Windows::first_base;
    windows.is_copy[w] = 0;
  }
  if (!back.empty()) {
    makeWindows(fitter, back, windows, lists);
    around = thicknessAround(windows, workers);
  }
  for (int w = 0; w < n; ++w)
    if (around[w] > 2 * thick) is_none[w] = 1;
  return is_none;
}

/// The variance of the noise around each point: creases and bends only add to residuals, so a low quantile of them.
RawBuffer<double> noiseVariance(const Windows& windows, const Workers& workers) {
  RawBuffer<double> median(windows.base.size()), variance(windows.base.size());
  forEachPoint(windows, workers, [&](int p) {
    const double found = pooledMedian(p, windows.near[p], [&](int q) { return windows.fits[q][0].variance; });
    median[p] = std::min(found / chi_median, windows.radius[p] * windows.radius[p]);
  });
  forEachPoint(windows, workers, [&](int p) {
    variance[p] = low_correction * pooledQuantile(p, windows.near[p], low_rank, [&](int q) { return median[q]; });
  });
  return variance;
}

bool isOutlier(const Windows& windows, int p, double variance) {
  const WindowFit& fit = windows.fits[p][Windows::base_size];
  if (!(variance > leastVariance(windows, p))) return false;  // exact points, of which none moves
  // Its neighbours belong to a surface that does not reach it, or lie so far away that the fit goes through it.
  if (fit.count < alone * windows.base[p] || (std::isfinite(fit.variance) && fit.leverage > most_leverage)) return true;
  if (!std::isfinite(fit.variance) || !(fit.variance > outlier_growth * variance)) return false;
  const double sigma = std::sqrt(variance * (1 - fit.leverage));
  return std::abs(fit.height) > std::max(outlier_sigmas * sigma, outlier_spacings * windows.spacing(p));
}

/// Where there is noise that can be told from the shape of the surface: the residuals of the two windows are alike, and
/// no exact points are around.
/// @param noise whose `noisy` is found by the rest
void findNoisy(const Windows& windows, const Workers& workers, NoiseLevel& noise) {
  const auto is_strong = [&](int p) { return noise.variance[p] > leastVariance(windows, p); };
  RawBuffer<double> exact_around(windows.base.size());  // share of exact points around each
  forEachPoint(windows, workers, [&](int p) {
    const double bound = exact * leastVariance(windows, p);
    exact_around[p] =
        pooledMean(p, windows.near[p], [&](int q) { return windows.fits[q][0].variance < bound ? 1 : 0; });
  });
  Buffer<std::uint8_t> sure(windows.base.size());
  forEachPoint(windows, workers, [&](int p) {
    double small = 0, base = 0, exact_points = 0;  // sums over the pool
    forEachPooled(p, windows.near[p], [&](int q, int times) {
      small += times * residualOf(windows.fits[q][0]);
      base += times * residualOf(windows.fits[q][Windows::base_size]);
      exact_points += times * exact_around[q];
    });
    const bool is_sure =
        is_strong(p) && exact_points < exact_share * (Windows::pooled + 1) && base < noise_growth * small;
    sure[p] = is_sure ? 1 : 0;
  });
  noise.noisy.resize(windows.base.size());
  forEachPoint(windows, workers, [&](int p) {
    const double share = pooledMean(p, windows.near[p], [&](int q) { return sure[q]; });
    const bool is_noisy = is_strong(p) && share > sure_share && noise.outlier[p] == 0 && noise.no_surface[p] == 0;
    noise.noisy[p] = is_noisy ? 1 : 0;
  });
}

}  // namespace

double leastVariance(const Windows& windows, int w) {
  const double least = least_noise * windows.spacing(w);
  return least * least;
}

bool mayBeNoisy(const PointsView& points, const NeighborSource& source, const Workers& workers) {
  const auto n = static_cast<int>(points.rows());
  if (n <= Windows::first_base) return false;
  Windows windows;
  windows.resize(n, std::max(n / most_samples, std::clamp(n / least_samples, 1, sample_stride)));
  windows.fitted = widest_judged + 1;
  WindowFitter(points, source, workers).take(allOf(windows), windows);
  int like_noise = 0;  // where most windows around are not exact
  for (int begin = 0; begin < windows.size(); begin += samples_around) {
    const int end = std::min(begin + samples_around, windows.size());
    int like_noise_here = 0, exact_here = 0;
    for (int w = begin; w < end; ++w) {
      const auto& fits = windows.fits[w];
      const double least = leastVariance(windows, w);
      const double widest = fits[widest_judged].variance;
      like_noise_here += fits[0].variance > least && widest < sample_growth * fits[0].variance ? 1 : 0;
      exact_here += fits[0].variance < exact * least ? 1 : 0;
    }
    if (exact_here < most_exact * (end - begin)) like_noise += like_noise_here;
  }
  return like_noise > least_share * windows.size();
}

NoiseLevel findNoise(const WindowFitter& fitter, const Workers& workers, Windows& windows, NeighborLists& lists) {
  NoiseLevel noise;
  makeWindows(fitter, allOf(windows), windows, lists);
  noise.no_surface = widen(fitter, workers, windows, lists);
  noise.variance = noiseVariance(windows, workers);
  noise.outlier.resize(windows.base.size());
  for (int w = 0; w < windows.size(); ++w) noise.outlier[w] = isOutlier(windows, w, noise.variance[w]) ? 1 : 0;
  findNoisy(windows, workers, noise);
  return noise;
}

void findOutliers(const WindowFitter& fitter, std::span<const int> which, NeighborLists& lists, const Workers& workers,
                  Windows& windows, NoiseLevel& noise) {
  Buffer<std::uint8_t> is_new(windows.base.size(), 0);
  for (int round = 0; round < outlier_rounds; ++round) {
    const Buffer<int> found = listedWhere(
        which, workers, [&](int p) { return noise.outlier[p] == 0 && isOutlier(windows, p, noise.variance[p]); });
    if (found.empty()) return;
    for (const int p : found) noise.outlier[p] = is_new[p] = 1;
    const Buffer<int> holding = listedWhere(
        which, workers, [&](int p) { return std::ranges::any_of(lists.of(p), [&](int q) { return is_new[q] != 0; }); });
    fitter.refit(holding, lists, noise.outlier, windows);
    for (const int p : found) is_new[p] = 0;
  }
}

}  // namespace tufted
