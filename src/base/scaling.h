#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/parallel.h"
#include "base/power_of_two.h"
#include "tufted/types.h"

namespace tufted {

/// Centre and size of a point set (step 1 of docs/algorithm.md), by medians, so that a far outlier does not shrink the
/// rest to a point. Computed from differences only: moving the points by an exact offset moves `center` and changes
/// nothing else.
struct Scaling {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< median of each coordinate
  Eigen::Array3d lowest = Eigen::Array3d::Zero();    ///< least coordinates of active points; infinite if there are none
  int exponent = 0;                                  ///< 2^exponent is the least power of two above the median spread

  /// From the caller's unit to scaled coordinates.
  PowerOfTwo toScaled() const { return PowerOfTwo(-exponent); }
};

/// Whether a point so far from the centre, in its farthest coordinate, takes part: at most 1e70 median spreads and
/// 1e152.
bool isWithinReach(const Scaling& scaling, double deviation);

/// Makes the unit large enough for the scaled coordinates of a tiny cloud that is very far away to stay finite.
/// @param largest the largest |coordinate| of points that take part
void widenUnit(Scaling& scaling, double largest);

/// The scaling of the points (N x 3).
/// @param[out] status N; not_finite for rows that are not finite, or more than 1e70 median spreads or 1e152 from the
/// centre; active for all others
Scaling measureScaling(const PointsRef& points, std::vector<PointStatus>& status, const Workers& workers);

}  // namespace tufted
