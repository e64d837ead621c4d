#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "algorithms/connected.h"
#include "base/dense_solvers.h"
#include "operators/lower_triangle.h"
#include "tufted/solver.h"

namespace tufted {

/// The constants on parts of a Laplacian that are joined by tiny weights only. A factor of the whole matrix computes
/// the flow between parts as a difference of strong weights, in which the tiny ones are lost; sums of rows of L over
/// parts contain only the tiny ones. So one point of each part stays out of the factor and is solved for here, by the
/// Schur complement of these sums.
class PartConstants {
 public:
  /// A solve with the first point of each floating part, and all pinned points, held at 0: N x c to N x c.
  using Inner = std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)>;

  /// @param L without weights between components
  /// @param points active points without a given value, ascending
  /// @param parts see findParts()
  /// @param floating by part; 1 if none of its points has a given value
  PartConstants(const SparseMatrix& L, const std::vector<int>& points, const Components& parts,
                const std::vector<std::uint8_t>& floating, const Inner& inner);

  /// Whether the Schur complement is positive definite.
  bool isDefinite() const { return complement_.isDefinite(); }

  /// Solves L x = rest, up to the accuracy of `inner`.
  /// @param rest N x c
  Eigen::MatrixXd solve(const SparseMatrix& L, const std::vector<int>& points, const Eigen::MatrixXd& rest,
                        const Inner& inner) const;

 private:
  Eigen::MatrixXd sums(const Eigen::MatrixXd& values) const;

  std::vector<int> number_;     ///< N; number of each point's floating part, or -1
  Eigen::MatrixXd extensions_;  ///< N x floating parts; column k is 1 at the first point of part k, and L times it is 0
                                ///< at all other points
  DenseCholesky complement_;
};

/// The two parts of a Laplacian that the weakest link joins; nullopt if no part is joined by less than `weak_share`.
std::optional<WeakJoint> weakestJoint(const SparseMatrix& L);

/// Finds the weakest joint of any positive definite matrix, in which the excess of a diagonal over its row joins a
/// point to a fixed value.
/// @param lower triangle over `points`
std::optional<WeakJoint> weakestJoint(const LongMatrix& lower, const std::vector<int>& points);

/// If the residual |b - A x| / |b| is above this, the report names the weakest joint.
constexpr double large_residual = 1e-8;

}  // namespace tufted
