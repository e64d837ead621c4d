#pragma once

#include <cstdint>
#include <optional>

#include "simd/kernels.h"

namespace tufted {

/// A fit of the inverse depth up to the rim of a body, over a part of a window.
struct RimFit {
  double value;     ///< in the middle
  double misfits;   ///< squares of the residuals, all together
  double leverage;  ///< variance of the value, by that of each pixel
  double gap;       ///< pixels from the last pixel of the window on to the silhouette
};

/// Near the silhouette of a body that curves away from the sensor the inverse depth changes like the root of the
/// distance from it in the image, however round the body is, and no quadratic follows that. So where `s` goes across
/// the rim and `t` along it, this fits the six unknowns of `a + b t + c sqrt(s + d + e t + f t^2)` by a few steps of
/// Gauss and Newton. On quadrics it is exact but for the slope across of the mean of their two sides.
/// @param along_rows,along_columns how a plane over these pixels changes; the body lies where it rises
/// @param noise of each pixel
/// @returns nothing where these pixels do not tell the unknowns
std::optional<RimFit> fitRim(const PixelRows& ranges, std::uint64_t around, double along_rows, double along_columns,
                             double noise);

}  // namespace tufted
