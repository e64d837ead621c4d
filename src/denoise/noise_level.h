#pragma once

#include <span>

#include "base/parallel.h"
#include "denoise/windows.h"

namespace tufted {

/// What windows say about noise.
struct NoiseLevel {
  RawBuffer<double> variance;    ///< of the noise around the middle of each, in length^2
  Buffer<std::uint8_t> outlier;  ///< whether the middle lies far off the surface of its neighbours
  Buffer<std::uint8_t> noisy;    ///< whether there is noise that can be told from the shape of the surface
  /// Whether there is none: the points around are a curve, fill a volume, or are as thick as wide.
  Buffer<std::uint8_t> no_surface;
};

/// Below this part of the spacing noise does nothing to a Laplacian.
constexpr double least_noise = 0.01;

/// A fit in a base window with more leverage passes through its point and says nothing about it. Inside a surface the
/// leverage is about .2, at a corner .7.
constexpr double most_leverage = 0.9;

/// An outlier lies so many sigmas and spacings off the surface of its neighbours. Of normal noise one point in a
/// million is that many sigmas off; nearer ones than a spacing do little harm.
constexpr double outlier_sigmas = 5, outlier_spacings = 1;

/// Residuals of a window without a bend have a variance below this, in variances of the noise; those of a window across
/// a crease have 2 and more.
constexpr double explained = 1.3;

/// The least variance of noise that matters around a window.
double leastVariance(const Windows& windows, int w);

/// Whether a few windows spread over the cloud have residuals like those of noise. Where hardly any have, there is none
/// to speak of; this takes next to no time.
/// @param source by search, for Windows::first_base neighbours
bool mayBeNoisy(const PointsView& points, const NeighborSource& source, const Workers& workers);

/// Makes windows, wider ones where the points are as thick as wide, and decides where there is noise.
/// @param windows with room
/// @param[out] lists gets the neighbours of each window that is no copy
NoiseLevel findNoise(const WindowFitter& fitter, const Workers& workers, Windows& windows, NeighborLists& lists);

/// Finds outliers, leaves them out of the fits around them, and looks again for those that had hidden behind them.
/// @param which windows that are looked at, ascending
/// @param lists their neighbours
/// @param windows around every point
/// @param noise whose outliers are found
void findOutliers(const WindowFitter& fitter, std::span<const int> which, NeighborLists& lists, const Workers& workers,
                  Windows& windows, NoiseLevel& noise);

}  // namespace tufted
