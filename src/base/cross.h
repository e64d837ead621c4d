#pragma once

#include <Eigen/Core>

namespace tufted {

/// Twice the area between two vectors of the plane: positive where b points to the left of a.
template <class A, class B>
typename A::Scalar cross(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) {
  return a[0] * b[1] - a[1] * b[0];
}

}  // namespace tufted
