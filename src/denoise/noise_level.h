#pragma once

#include <cstdint>

#include "base/parallel.h"
#include "denoise/surface_fits.h"

namespace tufted {

/// The noise around a centre, and the size of fit to use there.
struct LocalNoise {
  double variance = 0;      ///< variance of the noise along the normal, in length^2
  int size = -1;            ///< index in fit_sizes of the least expected error; -1 if points stay
  bool no_surface = false;  ///< whether the points around form a curve or fill a volume
};

/// By how many standard deviations the variance of a fit's residuals exceeds that of the noise.
/// @param size index in fit_sizes
double excessOf(const SurfaceFit& fit, int size, double variance);

/// Finds noise by predicting points from their neighbours. White noise makes predictions from 16 and from 32 neighbours
/// equally wrong, once squaredError() has removed their own variance; detail is predicted worse by a factor of two to
/// four from wider windows.
/// @returns the noise around each centre
RawBuffer<LocalNoise> findNoise(const SurfaceFits& fits, const Workers& workers);

/// A first look (section 27 of docs/algorithm.md, step 1): where there may be noise.
/// @param normals n x 3, or 0 x 3 if not known
/// @returns n, 1 where points may be noisy
Buffer<std::uint8_t> whereNoiseMayBe(const PointsView& points, const PointBuffer& normals, const NeighborSearch& search,
                                     const Workers& workers);

}  // namespace tufted
