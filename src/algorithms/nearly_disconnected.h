#pragma once

#include <Eigen/Cholesky>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "algorithms/connected.h"
#include "operators/lower_triangle.h"
#include "tufted/solver.h"

namespace tufted {

/// The badly joined parts of a Laplacian. A factor of the whole finds what flows from part to part as a difference of
/// strong weights, in which the weak ones between parts are lost; sums over parts hold nothing else. So one point of
/// each part stays out of the factor, and its value is found here, by the Schur complement that sums of L over parts
/// make.
class PartConstants {
 public:
  /// A solve with the first point of each floating part, and whatever is pinned, held at 0: N x c to N x c.
  using Inner = std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)>;

  /// @param L without weights between components
  /// @param points that are not pinned, ascending; borrowed, and so is L, by each call
  /// @param parts see findParts
  /// @param floating by part: 1 where no point is held at a value
  PartConstants(const SparseMatrix& L, const std::vector<int>& points, const Components& parts,
                const std::vector<std::uint8_t>& floating, const Inner& inner);

  /// Whether the complement is positive definite.
  bool isDefinite() const { return complement_.info() == Eigen::Success; }

  /// x with L x = rest.
  /// @param rest N x c
  Eigen::MatrixXd solve(const SparseMatrix& L, const std::vector<int>& points, const Eigen::MatrixXd& rest,
                        const Inner& inner) const;

 private:
  Eigen::MatrixXd sums(const Eigen::MatrixXd& values) const;

  std::vector<int> number_;     ///< N; of the floating part that a point lies in, or -1
  Eigen::MatrixXd extensions_;  ///< N x floating parts; 1 at the first point of each, and L of it is 0 elsewhere
  Eigen::LLT<Eigen::MatrixXd> complement_;
};

/// Of a Laplacian: the two parts of a component that the weakest path between any points joins. Nothing where no part
/// is joined by less than `weak_share`. To be asked where a residual stays above `large_residual`.
std::optional<WeakJoint> weakestJoint(const SparseMatrix& L);

/// The same of any positive definite matrix, where what the diagonal has beyond its row joins a point to a fixed value.
/// @param lower triangle over `points`
std::optional<WeakJoint> weakestJoint(const LongMatrix& lower, const std::vector<int>& points);

/// Above this a residual |b - A x| / |b| calls for an explanation.
constexpr double large_residual = 1e-8;

}  // namespace tufted
