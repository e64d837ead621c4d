#pragma once

#include <string>
#include <vector>

#include "tufted/laplacian.h"

namespace tufted {

/// Connected components of the active points. Weights at most 1e-14 of the smaller diagonal join nothing: they are lost
/// in the rounding of the rows, so a constant on either side costs no energy.
struct Components {
  int count = 0;
  std::vector<int> of;      ///< N; which component, numbered by their first points; -1: not active
  std::vector<int> points;  ///< the active points, ascending

  /// The component of the most points, of equal ones the first; -1 where there is none.
  int largest() const;
  /// The sums of `values` over each component, in ascending order of points.
  VectorXd sums(const VectorXd& values) const;
  /// M divided by its sum over the component; equal weights if that sum is 0. Points that are not active get 0.
  VectorXd weights(const VectorXd& M) const;

  /// Divides each column on each component by its largest magnitude there, so that iterations see them alike.
  /// @return what was divided by, components x columns; 1 where there is nothing but 0
  Eigen::MatrixXd normalise(Eigen::Ref<Eigen::MatrixXd> values) const;
  /// Multiplies columns on components by the factors that normalise() has divided by.
  void multiply(Eigen::Ref<Eigen::MatrixXd> values, const Eigen::MatrixXd& factors) const;
};

Components findComponents(const Laplacian& laplacian);

/// Why a point that is not active lies on no component, for errors: "source 3 is not finite".
/// @param what the point is to the caller
std::string whyOnNone(const std::string& what, int point, PointStatus status);

/// Parts joined only by weights of at most this part of the smaller diagonal are kept apart: a factor loses about 1e-13
/// over the part of a jump across such a joint.
constexpr double weak_share = 1e-6;
/// At most this many more parts than components are kept apart, as each takes a solve and N values.
constexpr int most_floating_parts = 64;

/// The parts that weights above `weak_share` of the smaller diagonal join, nearly always the components themselves. If
/// there would be too many parts, a smaller share is used.
Components findParts(const Laplacian& laplacian);

}  // namespace tufted
