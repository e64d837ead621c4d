#pragma once

#include <Eigen/Core>
#include <vector>

#include "tufted/laplacian.h"
#include "tufted/options.h"
#include "tufted/types.h"

namespace tufted {

/// The active point nearest to a position, the first one if several are equally near. O(N).
/// @param points N x 3, those that the Laplacian was built from
/// @throws InvalidInput for positions or active points that are not finite, arrays of different sizes, or no active
///         point
int nearestPoint(const Laplacian& laplacian, const PointsRef& points, const Eigen::Vector3d& position);

/// The active points nearest to many positions, found by a search tree: O(N log N), then O(log N) for each position
/// that is near the points. Errors are those of nearestPoint().
/// @param positions P x 3
/// @return P indices
/// @throws Cancelled when `progress` returns false
std::vector<int> nearestPoints(const Laplacian& laplacian, const PointsRef& points, const PointsRef& positions,
                               const Progress& progress = {});

}  // namespace tufted
