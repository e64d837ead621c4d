#pragma once

#include <Eigen/Core>

#include "shapes/random.h"
#include "tufted/tracing.h"

// Helpers of the tests of traced lines.
namespace tufted::support {

inline Eigen::RowVector3d lastOf(const TracedLine& traced) {
  return traced.line.points.row(traced.line.points.rows() - 1);
}

inline Eigen::RowVector3d randomDirection(shapes::Random& random) {
  return {random.normal(), random.normal(), random.normal()};
}

inline double polylineLength(const Points& points) {
  double length = 0;
  for (Eigen::Index i = 0; i + 1 < points.rows(); ++i) length += (points.row(i + 1) - points.row(i)).norm();
  return length;
}

}  // namespace tufted::support
