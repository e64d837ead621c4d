#pragma once

#include <Eigen/Core>
#include <vector>

#include "tufted/laplacian.h"
#include "tufted/options.h"
#include "tufted/types.h"

namespace tufted {

/// Finds the active point nearest to a position, of equally near ones the first, in O(N).
/// @param points N x 3, those that the Laplacian was built from
/// @param position in the unit of the points
/// @return index of the point
/// @throws InvalidInput for a position or active points that are not finite, arrays of different sizes, or no active
/// point
int nearestPoint(const Laplacian& laplacian, const PointsRef& points, const Eigen::Vector3d& position);

/// Finds the active points nearest to many positions with a search tree: O(N log N), then O(log N) for each position
/// near the points. Errors are those of nearestPoint().
/// @param positions P x 3, in the unit of the points
/// @return P indices
/// @throws Cancelled when `progress` returns false
std::vector<int> nearestPoints(const Laplacian& laplacian, const PointsRef& points, const PointsRef& positions,
                               const Progress& progress = {});

}  // namespace tufted
