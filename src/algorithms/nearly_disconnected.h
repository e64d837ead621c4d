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

/// The constants on badly joined parts of a Laplacian. A factor of the whole matrix finds what flows from part to part
/// as a difference of strong weights, in which the weak weights between parts are lost; sums over parts hold only the
/// weak ones. So one point of each part stays out of the factor, and its value is found here, by the Schur complement
/// that sums of L over parts make.
class PartConstants {
 public:
  /// A solve with the first point of each floating part, and all pinned points, held at 0: N x c to N x c.
  using Inner = std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)>;

  /// @param L without weights between components
  /// @param points that are not pinned, ascending; borrowed, and so is L, by each call
  /// @param parts see findParts
  /// @param floating by part: 1 where no point is held at a value
  PartConstants(const SparseMatrix& L, const std::vector<int>& points, const Components& parts,
                const std::vector<std::uint8_t>& floating, const Inner& inner);

  /// Whether the complement is positive definite.
  bool isDefinite() const { return complement_.info() == Eigen::Success; }

  /// Solves L x = rest.
  /// @param rest N x c
  Eigen::MatrixXd solve(const SparseMatrix& L, const std::vector<int>& points, const Eigen::MatrixXd& rest,
                        const Inner& inner) const;

 private:
  Eigen::MatrixXd sums(const Eigen::MatrixXd& values) const;

  std::vector<int> number_;     ///< N; number of the floating part that a point lies in, or -1
  Eigen::MatrixXd extensions_;  ///< N x floating parts; 1 at the first point of each, and L of it is 0 elsewhere
  Eigen::LLT<Eigen::MatrixXd> complement_;
};

/// The two parts of a Laplacian's component that the weakest link joins. Returns nullopt if no part is joined by less
/// than `weak_share`. To be called if a residual stays above `large_residual`.
std::optional<WeakJoint> weakestJoint(const SparseMatrix& L);

/// The two parts of any positive definite matrix that the weakest link joins. The excess of a diagonal over its row
/// joins a point to a fixed value. Returns nullopt if no part is joined by less than `weak_share`.
/// @param lower triangle over `points`
std::optional<WeakJoint> weakestJoint(const LongMatrix& lower, const std::vector<int>& points);

/// If the residual |b - A x| / |b| is above this, the report names the two parts that a weak joint separates.
constexpr double large_residual = 1e-8;

}  // namespace tufted
