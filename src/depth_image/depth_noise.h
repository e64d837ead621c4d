#pragma once

#include "base/parallel.h"
#include "base/point_buffer.h"
#include "depth_image/pixel_grid.h"

namespace tufted {

/// The standard deviation of inverse ranges about smooth surfaces, in the inverse unit of the cloud: the noise and the
/// steps of a camera that measures disparities have it everywhere in the image. From fourth differences of five pixels
/// in a row, which curved surfaces hardly have, less the largest tenth, which are edges.
double inverseRangeNoise(const PixelGrid& grid, const PointsView& points, const Workers& workers);

}  // namespace tufted
