#pragma once

#include <cstdint>
#include <optional>

#include "simd/kernels.h"

namespace tufted {

/// A quadratic over a whole square of pixels: its value in the middle and the variance of the residuals.
struct SquareFit {
  double value, variance;
};

/// An inverse depth without the noise of its pixel.
struct SmoothedRange {
  double inverse;   ///< the value
  double variance;  ///< of it, by the residuals of the fit
};

/// Whether noise counts beside the spacing of the pixels and the rounding of ranges.
/// @param noise of the whole image, see inverseRangeNoise()
/// @param spacing_squared of neighbouring pixels in inverse depth
bool needsSmoothing(double inverse_range, double noise, double spacing_squared);

/// The inverse depth of the surface at a pixel, by least squares over the window. Inverse depths of a plane are linear
/// over a pinhole camera's image.
///
/// Where the whole window is one surface, a quadratic over 7 x 7 pixels, or over 5 x 5 where the residuals are more
/// than noise; at edges a plane, where it fits as well as noise allows. A surface that is steep at an edge bends away
/// from the sensor, as up to the rim of a ball, which no plane follows: there a point stays.
/// @param around see SurfaceWindows
/// @param ranges around the pixel, lane 0
/// @param narrow, wide over 5 x 5 and 7 x 7 pixels; not looked at where these are not whole
/// @param spacing_squared see needsSmoothing()
/// @returns nothing where the point should stay where it is
std::optional<SmoothedRange> smoothedInverseDepth(const PixelRows& ranges, std::uint64_t around,
                                                  const SquareFit& narrow, const SquareFit& wide, double noise,
                                                  double spacing_squared);

/// Smooths a range again, by a fit to values that were smoothed before, of pixels some distance apart: a quadratic over
/// a whole window of 7 x 7, or of 5 x 5, or a plane over a part of it.
/// @param around which of the pixels are of one surface with the middle one
/// @param noise_variance that fits to these values are expected to leave
/// @returns nothing where they do not fit as well as noise allows
std::optional<SmoothedRange> smoothedFurther(const SquareFit& wide, const SmoothedRange& before, double noise_variance);
std::optional<SmoothedRange> smoothedNearer(const SquareFit& narrow, const SmoothedRange& before,
                                            double noise_variance);
std::optional<SmoothedRange> smoothedFurther(const PixelRows& ranges, std::uint64_t around, const SmoothedRange& before,
                                             double noise_variance);

}  // namespace tufted
