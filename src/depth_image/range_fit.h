#pragma once

#include <cstdint>
#include <optional>

#include "simd/kernels.h"

namespace tufted {

/// Fit of a quadratic over a square of pixels: its value in the middle and the variance of its residuals.
struct SquareFit {
  double value, variance;
};

/// A smoothed inverse depth.
struct SmoothedRange {
  double inverse;   ///< the value
  double variance;  ///< variance of `inverse`, from the residuals of the fit
};

/// Whether noise matters, compared with the spacing of the pixels and the rounding of ranges.
/// @param noise standard deviation of the inverse depth, see RangeNoise::atInverse()
/// @param spacing_squared mean squared spacing of neighbouring pixels, in inverse depth
bool needsSmoothing(double inverse_range, double noise, double spacing_squared);

/// The inverse depth of the surface at a pixel, by least squares over its window (step 4 in section 28 of
/// docs/algorithm.md, after Savitzky and Golay 1964).
///
/// If the window contains all of 5 x 5 pixels, that of a quadratic, over 7 x 7 if these are complete and the residuals
/// are noise. At edges that of a plane, if it fits as well as noise allows. A surface that is steep at an edge curves
/// away from the sensor, as at the rim of a ball, which no plane follows: there a point stays.
/// @param around see SurfaceWindows::around
/// @param ranges inverse depths around the pixel, lane 0
/// @param narrow, wide fits over 5 x 5 and 7 x 7 pixels; not read if these are not complete
/// @param spacing_squared see needsSmoothing()
/// @returns nothing if the point should stay
std::optional<SmoothedRange> smoothedInverseDepth(const PixelRows& ranges, std::uint64_t around,
                                                  const SquareFit& narrow, const SquareFit& wide, double noise,
                                                  double spacing_squared);

/// Smooths an inverse depth again, by a fit to smoothed values of pixels some distance apart: a quadratic over 7 x 7 of
/// them (smoothedNearer(): 5 x 5), or a plane over a part.
/// @param around pixels of one surface with the middle one
/// @param noise_variance variance that fits to these values are expected to leave
/// @returns nothing if the fit is worse than noise allows
std::optional<SmoothedRange> smoothedFurther(const SquareFit& wide, const SmoothedRange& before, double noise_variance);
std::optional<SmoothedRange> smoothedNearer(const SquareFit& narrow, const SmoothedRange& before,
                                            double noise_variance);
std::optional<SmoothedRange> smoothedFurther(const PixelRows& ranges, std::uint64_t around, const SmoothedRange& before,
                                             double noise_variance);

}  // namespace tufted
