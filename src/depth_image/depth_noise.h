#pragma once

#include "base/parallel.h"
#include "base/point_buffer.h"
#include "depth_image/pixel_grid.h"
#include "depth_image/range_noise.h"

namespace tufted {

/// The noise of ranges, or the rounding to steps (section 28 of docs/algorithm.md, step 2): from fourth differences of
/// the inverse depths of five pixels in a row, nearly 0 on smooth surfaces, without the largest tenth, which are edges.
/// How they depend on the inverse depth shows if the sensor measures disparities or ranges.
RangeNoise rangeNoise(const PixelGrid& grid, const PointsView& points, const Workers& workers);

}  // namespace tufted
