#pragma once

#include <cstdint>

#include "base/parallel.h"
#include "denoise/surface_fits.h"

namespace tufted {

/// The noise around a centre, and which fit says best where the surface is.
struct LocalNoise {
  double variance = 0;      ///< along the normal, in length^2
  int size = -1;            ///< of fit_sizes, that of the fit with the least expected error; -1 where points stay
  bool no_surface = false;  ///< the points around are a curve or fill a volume
};

/// By how much the residuals of a fit vary more than noise of a variance explains, in standard deviations of chance.
double excessOf(const SurfaceFit& fit, int size, double variance);

/// Finds noise by predicting points from their neighbours. White noise makes predictions from 16 and from 32 neighbours
/// equally wrong, but for the predictions' own variance, which squaredError() takes away; from wider windows detail is
/// predicted worse by a factor of two to four.
/// @returns one for each centre
RawBuffer<LocalNoise> findNoise(const SurfaceFits& fits, const Workers& workers);

/// A first look, for next to nothing: where there may be noise.
/// @returns n, 1 there
Buffer<std::uint8_t> whereNoiseMayBe(const PointsView& points, const NeighborSearch& search, const Workers& workers);

}  // namespace tufted
