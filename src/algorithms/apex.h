#pragma once

#include <Eigen/Core>

namespace tufted {

/// The corner of a triangle opposite its side from `a` to `b`, to the left of that side.
/// @param to_a, to_b lengths of the other two sides
/// @param double_area twice the triangle's area
inline Eigen::Vector2d apexLeftOf(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double to_a, double to_b,
                                  double double_area) {
  const Eigen::Vector2d along = b - a;
  const double length = along.norm();
  if (!(length > 0)) return a + Eigen::Vector2d(to_a, 0);
  const Eigen::Vector2d unit = along / length;
  const double x = (length + (to_a - to_b) * ((to_a + to_b) / length)) / 2, y = double_area / length;
  return a + x * unit + y * Eigen::Vector2d(-unit.y(), unit.x());
}

}  // namespace tufted
