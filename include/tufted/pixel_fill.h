#pragma once

#include <Eigen/Core>

#include "tufted/types.h"

namespace tufted {

/// The share of pixels that hold points, among those near a pixel with a point (5 x 5), in the mean over the points of
/// an organized cloud. Holes do not lessen it, however large; where half of the pixels are missing at random it is a
/// half. Rows and columns without any point are left out, as in a build, unless those that hold points are more than 12
/// times as far apart one way as the other; points at the origin count as missing.
/// @param points width x height rows, row-major
/// @returns 0 without a point, and for another number of points
double pixelFill(const Points& points, int width, int height, const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

/// Where pixelFill() is less, a depth image is built better by neighbours in space: windows of pixels hold too little
/// of the surface to tell noise and jumps by. So isDepthImage() takes it for none.
inline constexpr double least_pixel_fill = 0.65;

}  // namespace tufted
