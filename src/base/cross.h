#pragma once

#include <Eigen/Core>
#include <cmath>

namespace tufted {

/// Twice the area between two vectors of the plane: positive where b points to the left of a.
template <class A, class B>
typename A::Scalar cross(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) {
  return a[0] * b[1] - a[1] * b[0];
}

/// The angle between two vectors of the plane, rad.
inline double angleBetween(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return std::atan2(std::abs(cross(a, b)), a.dot(b));
}

/// The vector of the plane with this length in the direction `angle`, rad.
inline Eigen::Vector2d polar(double length, double angle) {
  return length * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

}  // namespace tufted
