#include "stars/star_gap.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tufted {
namespace {

/// Two unit vectors whose sum is shorter than this count as opposite.
constexpr double opposite = 1e-3;

}  // namespace

Eigen::Vector2d middleOfGap(const DelaunayStar& star) {
  if (star.link.empty()) return Eigen::Vector2d::Zero();
  const PlanarPoint &first = star.link.front(), &last = star.link.back();
  const Eigen::Vector2d a = Eigen::Vector2d(first.u, first.v).normalized();
  const Eigen::Vector2d b = Eigen::Vector2d(last.u, last.v).normalized();
  // Opposite to the mean direction of the two ends; if these are nearly opposite, perpendicular to the last one.
  return (a + b).norm() > opposite ? Eigen::Vector2d(-a - b) : Eigen::Vector2d(-b.y(), b.x());
}

bool leaveGap(const Buffer<PlanarPoint>& points, const Eigen::Vector2d& middle) {
  const PlanarPoint* begin = nullptr;  // start of the gap: the next point to the right of the middle
  double least = std::numeric_limits<double>::infinity();
  for (const PlanarPoint& q : points) {
    const double along = q.u * middle.x() + q.v * middle.y(), across = q.v * middle.x() - q.u * middle.y();
    if (across > 0 || (across == 0 && along >= 0)) continue;
    const double angle = 1 - along / (std::abs(along) + std::abs(across));  // increases with the angle, 0 to 2
    if (angle >= least) continue;
    least = angle;
    begin = &q;
  }
  return begin != nullptr &&
         std::all_of(points.begin(), points.end(), [&](const PlanarPoint& q) { return orientation(*begin, q) <= 0; });
}

}  // namespace tufted
