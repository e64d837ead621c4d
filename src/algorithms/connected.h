#pragma once

#include <vector>

#include "tufted/laplacian.h"

namespace tufted {

/// Connected components of the active points. Weights at most 1e-14 of the smaller diagonal join nothing: they are lost
/// in the rounding of the rows, so a constant on either side costs no energy.
struct Components {
  int count = 0;
  std::vector<int> of;      ///< N; which component, numbered by their first points; -1: not active
  std::vector<int> points;  ///< the active points, ascending

  /// The sum over each component, in ascending order of points.
  VectorXd sums(const VectorXd& values) const;
  /// M divided by its sum over the component; all equal where that sum is 0. 0 at points that are not active.
  VectorXd weights(const VectorXd& M) const;

  /// Divides each column on each component by its largest magnitude there, so that iterations see them alike.
  /// @return what was divided by, components x columns; 1 where there is nothing but 0
  Eigen::MatrixXd normalise(Eigen::Ref<Eigen::MatrixXd> values) const;
  /// Multiplies by what normalise() has divided by.
  void multiply(Eigen::Ref<Eigen::MatrixXd> values, const Eigen::MatrixXd& factors) const;
};

Components findComponents(const Laplacian& laplacian);

/// Weights of at most this part of the smaller diagonal join badly. A factor loses so many digits of what flows through
/// them: some 1e-13 over it, of a jump.
constexpr double weak_share = 1e-6;
/// As many parts more than components are kept apart, as each takes a solve and N values.
constexpr int most_floating_parts = 64;

/// The parts of the components that weights above `weak_share` of the smaller diagonal join, nearly always the
/// components themselves; above less, where there would be too many parts.
Components findParts(const Laplacian& laplacian);

}  // namespace tufted
