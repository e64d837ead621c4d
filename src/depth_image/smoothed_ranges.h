#pragma once

#include <cstdint>

#include "base/buffer.h"
#include "base/parallel.h"
#include "base/point_buffer.h"
#include "depth_image/pixel_grid.h"
#include "depth_image/range_fit.h"

namespace tufted {

/// Inverse ranges without noise, by rank.
struct SmoothedRanges {
  RawBuffer<SmoothedRange> range;
  RawBuffer<double> spacing_squared;  ///< of neighbouring pixels, in inverse range

  void resize(std::size_t n) {
    range.assign(n, {0, 0});
    spacing_squared.assign(n, 0);
  }
};

/// Where what is left of the noise is not small against the spacing of the pixels, as on walls far away, smooths again
/// over pixels that are 3 apart, then 9: over 19 pixels, then 55, and more by what was smoothed before.
void smoothFurther(const PixelGrid& grid, SmoothedRanges& smoothed, double noise, const Workers& workers);

/// From each point along its ray to the smoothed range, n x 3.
/// @param[out] moved points whose displacement is not 0
PointBuffer displacementsAlongRays(const PixelGrid& grid, const PointsView& points, const SmoothedRanges& smoothed,
                                   const Workers& workers, std::int64_t& moved);

}  // namespace tufted
