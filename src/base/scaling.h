#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/parallel.h"
#include "base/power_of_two.h"
#include "tufted/types.h"

namespace tufted {

/// Where most of a point set lies and how wide it is, by medians, so that no sentinel or outlier can flatten it.
/// Computed from differences only: moving the points by an exact offset moves `center` and changes nothing else.
struct Scaling {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< median of each coordinate
  Eigen::Array3d lowest = Eigen::Array3d::Zero();    ///< of each coordinate of active points; infinite without any
  int exponent = 0;                                  ///< 2^exponent is just above the median spread

  /// Multiplies by 2^-exponent.
  PowerOfTwo toScaled() const { return PowerOfTwo(-exponent); }
};

/// Scaling of the finite rows. Rows that are not finite, or more than 1e70 median spreads or 1e152 from the centre,
/// get PointStatus::not_finite in `status` (resized to N; all others active).
Scaling measureScaling(const PointsRef& points, std::vector<PointStatus>& status, const Workers& workers);

}  // namespace tufted
