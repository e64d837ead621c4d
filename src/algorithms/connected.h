#pragma once

#include <string>
#include <vector>

#include "tufted/laplacian.h"

namespace tufted {

/// Connected components of the active points. Weights of at most 1e-14 of the smaller of two diagonals do not join:
/// they are lost in the rounding of the rows, so different constants on both sides cost no energy.
struct Components {
  int count = 0;
  std::vector<int> of;      ///< N; number of each point's component, in the order of their first points; -1: not active
  std::vector<int> points;  ///< the active points, ascending

  /// The component with the most points, of equal ones the first; -1 if there is none.
  int largest() const;
  /// The sums of `values` over each component, in ascending order of points.
  VectorXd sums(const VectorXd& values) const;
  /// M divided by its sum over the component; equal weights if that sum is 0. Points that are not active get 0.
  VectorXd weights(const VectorXd& M) const;

  /// Divides each column on each component by its largest magnitude there, so that all have the same scale.
  /// @return the divisors, components x columns; 1 where all values are 0
  Eigen::MatrixXd normalise(Eigen::Ref<Eigen::MatrixXd> values) const;
  /// Multiplies columns on components by the divisors that normalise() returned.
  void multiply(Eigen::Ref<Eigen::MatrixXd> values, const Eigen::MatrixXd& factors) const;
};

Components findComponents(const Laplacian& laplacian);

/// Why a point lies on no component, for errors such as "source 3 is not finite".
/// @param what the caller's word for the point
std::string whyOnNone(const std::string& what, int point, PointStatus status);

/// Parts joined only by weights of at most this part of the smaller diagonal are solved for separately: across a weight
/// of the part p, a factor has a relative error of about 1e-13 / p.
constexpr double weak_share = 1e-6;
/// At most this many more parts than components are solved for separately, as each takes a solve and N values.
constexpr int most_floating_parts = 64;

/// The parts joined by weights above `weak_share` of the smaller diagonal, nearly always the components themselves. If
/// there would be too many, a smaller share is used.
Components findParts(const Laplacian& laplacian);

}  // namespace tufted
