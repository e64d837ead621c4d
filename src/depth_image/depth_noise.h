#pragma once

#include "base/parallel.h"
#include "base/point_buffer.h"
#include "depth_image/pixel_grid.h"
#include "depth_image/range_noise.h"

namespace tufted {

/// The noise and the steps of ranges about smooth surfaces. From fourth differences of inverse depths of five pixels in
/// a row, which curved surfaces hardly have, less the largest tenth, which are edges; and from how these grow with the
/// inverse depth, whether the sensor measures disparities or ranges.
RangeNoise rangeNoise(const PixelGrid& grid, const PointsView& points, const Workers& workers);

}  // namespace tufted
