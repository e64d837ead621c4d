#pragma once

#include <Eigen/Core>

#include "tufted/types.h"

namespace tufted {

/// How densely the pixels of an organized cloud are filled around its points: the share of pixels that hold a point, in
/// the 5 x 5 pixels around a point, averaged over the points. Holes hardly change it, however large; with half of the
/// pixels missing at random it is 0.5. Rows and columns without any point are left out, as in a build, unless the rows
/// that remain are more than 12 times as far apart as the columns, or the other way round. Points at the origin count
/// as missing.
/// @param points width x height rows, row by row
/// @param origin position of the sensor, in the unit of the points
/// @return in [0, 1]; 0 without a point or if `points` has another number of rows
double pixelFill(const Points& points, int width, int height, const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

/// A depth image with a smaller pixelFill() is built better from neighbours in space, because windows of pixels hold
/// too little of the surface to find noise and jumps. isDepthImage() returns false for it.
inline constexpr double least_pixel_fill = 0.65;

}  // namespace tufted
