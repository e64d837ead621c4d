#pragma once

#include "base/parallel.h"
#include "base/point_buffer.h"
#include "depth_image/pixel_grid.h"
#include "depth_image/range_noise.h"

namespace tufted {

/// Measures the noise of ranges, or the steps to which they are rounded (step 2 in section 28 of docs/algorithm.md):
/// from fourth differences of the inverse depths of five pixels in a row, which are nearly 0 on smooth surfaces,
/// without the largest tenth, which are edges. Their dependence on the inverse depth shows if the sensor measures
/// disparities or ranges.
RangeNoise rangeNoise(const PixelGrid& grid, const PointsView& points, const Workers& workers);

}  // namespace tufted
