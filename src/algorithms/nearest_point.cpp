#include "tufted/nearest_point.h"

#include <limits>
#include <string>

#include "tufted/check.h"
#include "tufted/errors.h"

namespace tufted {

int nearestPoint(const Laplacian& laplacian, const Points& points, const Eigen::Vector3d& position) {
  checkSizes("nearestPoint", laplacian);
  const auto n = static_cast<Eigen::Index>(laplacian.status.size());
  if (points.rows() != n) {
    throw InvalidInput("nearestPoint: points has " + std::to_string(points.rows()) + " rows, must have " +
                       std::to_string(n) + ", one per point of the Laplacian");
  }
  if (!position.allFinite()) throw InvalidInput("nearestPoint: position is not finite, must be");
  int nearest = -1;
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < n; ++i) {
    if (laplacian.status[i] != PointStatus::active) continue;
    const double distance = (points.row(i).transpose() - position).stableNorm();
    if (nearest >= 0 && !(distance < least)) continue;
    least = distance;
    nearest = static_cast<int>(i);
  }
  if (nearest < 0)
    throw InvalidInput("nearestPoint: none of the " + std::to_string(n) + " points is active, must be one");
  return nearest;
}

}  // namespace tufted
