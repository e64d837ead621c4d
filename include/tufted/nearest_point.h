#pragma once

#include <Eigen/Core>
#include <vector>

#include "tufted/laplacian.h"
#include "tufted/types.h"

namespace tufted {

/// The active point nearest to a position, the first one where several are. O(N).
/// @param points N x 3, those that the Laplacian was built from
/// @throws InvalidInput for positions or active points that are not finite, arrays of different sizes, or no active
///         point
int nearestPoint(const Laplacian& laplacian, const Points& points, const Eigen::Vector3d& position);

/// The same for many positions by a search tree: O(N log N), then O(log N) for each that is near the points.
/// @param positions P x 3
/// @return P
std::vector<int> nearestPoints(const Laplacian& laplacian, const Points& points, const Points& positions);

}  // namespace tufted
