#pragma once

#include <Eigen/SparseCholesky>
#include <cstdint>
#include <optional>
#include <vector>

#include "algorithms/connected.h"
#include "operators/lower_triangle.h"
#include "tufted/solver.h"

namespace tufted {

/// Constants on badly joined parts of a Laplacian. A factor of the whole finds what flows from part to part as a
/// difference of strong weights, in which the weak ones between parts are lost; sums over parts hold nothing else. So
/// one point of each part stays out of the factor, and its constant is found here.
class PartConstants {
 public:
  /// @param components of the same points; nothing flows between them
  /// @param parts see findParts
  /// @param floating by part: 1 where the constant is sought, 0 where it is known; each component has one of these
  PartConstants(const SparseMatrix& L, const Components& components, const Components& parts,
                const std::vector<std::uint8_t>& floating);

  /// Whether the weights between parts make a positive definite matrix.
  bool isDefinite() const { return factor_.info() == Eigen::Success; }

  /// Constants on the floating parts for which L leads out of each what `rest` has in it.
  /// @param rest N x c
  /// @return N x c; 0 elsewhere
  Eigen::MatrixXd solve(const Eigen::MatrixXd& rest) const;

 private:
  std::vector<int> number_;  ///< N; of the floating part that a point lies in, or -1
  Eigen::Index count_ = 0;
  Eigen::SimplicialLDLT<SparseMatrix> factor_;
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
