#pragma once

#include <Eigen/Core>

#include "tufted/laplacian.h"
#include "tufted/types.h"

namespace tufted {

/// The active point nearest to a position, the first one where several are. O(N).
/// @param points N x 3, those that the Laplacian was built from
/// @throws InvalidInput for a position that is not finite, arrays of different sizes, or no active point
int nearestPoint(const Laplacian& laplacian, const Points& points, const Eigen::Vector3d& position);

}  // namespace tufted
