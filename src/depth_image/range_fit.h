#pragma once

#include <cstdint>
#include <optional>

namespace tufted {

/// Inverse ranges around a pixel: w(step) of a pixel `row` rows and `column` columns on is at[row * stride + column].
struct InverseRanges {
  const double* at;
  int stride;
};

/// An inverse range without the noise of its pixel.
struct SmoothedRange {
  double inverse;   ///< the value
  double variance;  ///< of it, by the residuals of the fit
};

/// The inverse range of the surface at a pixel, by least squares over the window. Inverse ranges of a plane are linear
/// over a pinhole camera's image.
///
/// Where the whole window is one surface, a quadratic over 7 x 7 pixels, or over 5 x 5 where the residuals are more
/// than noise; at edges a plane, where it fits as well as noise allows.
/// @param around see SurfaceWindows
/// @param noise of the whole image, see inverseRangeNoise()
/// @param spacing_squared of neighbouring pixels in inverse range: noise far smaller than that is left alone
/// @returns nothing where the point should stay where it is
std::optional<SmoothedRange> smoothedInverseRange(const InverseRanges& ranges, std::uint64_t around, double noise,
                                                  double spacing_squared);

/// Smooths a range again, by a fit to values that were smoothed before, of pixels some distance apart.
/// @param ranges of the pixels of the window, 7 x 7 one after the other
/// @param around which of them are of one surface with the middle one
/// @returns `before` where they do not fit as well as noise allows
SmoothedRange smoothedFurther(const InverseRanges& ranges, std::uint64_t around, const SmoothedRange& before,
                              double noise);

}  // namespace tufted
