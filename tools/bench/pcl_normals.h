#pragma once

#include "tufted/types.h"

namespace tufted::bench {

/// Seconds that PCL takes on one thread for the normals of a cloud.
struct NormalSeconds {
  double by_neighbors;  ///< pcl::NormalEstimation with 30 neighbours
  double by_integrals;  ///< pcl::IntegralImageNormalEstimation, average of 3D gradients; NaN without rows
};

/// @param points width x height rows
NormalSeconds pclNormalSeconds(const Points& points, int width, int height);

}  // namespace tufted::bench
