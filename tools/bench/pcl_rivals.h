#pragma once

#include "tufted/types.h"

namespace tufted::bench {

/// Moves points by PCL's MovingLeastSquares.
/// @param radius radius of the fits, in the points' unit
/// @param order degree of the polynomials
Points movedByLeastSquares(const Points& points, double radius, int order);

/// Seconds that PCL takes for the normals of a cloud on one thread.
struct NormalSeconds {
  double by_neighbors;  ///< pcl::NormalEstimation with 30 neighbours
  double by_integrals;  ///< pcl::IntegralImageNormalEstimation, average of 3D gradients; NaN for one row of points
};

/// @param points width x height rows
NormalSeconds pclNormalSeconds(const Points& points, int width, int height);

}  // namespace tufted::bench
