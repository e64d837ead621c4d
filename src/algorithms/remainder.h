#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "operators/lower_triangle.h"
#include "tufted/types.h"

namespace tufted {

/// The remainder b - A x of a solution x, and its size relative to rounding.
struct Remainder {
  Eigen::MatrixXd rest;         ///< b - A x
  Eigen::RowVectorXd residual;  ///< by column: |rest| / |size|, Euclidean norms
  /// By column: the greatest |rest| / (|A| |x| + size) of any row; values close to underflow count as 0.
  Eigen::RowVectorXd backward_error;

  explicit Remainder(Eigen::MatrixXd begin)
      : rest(std::move(begin)),
        residual(Eigen::RowVectorXd::Zero(rest.cols())),
        backward_error(Eigen::RowVectorXd::Zero(rest.cols())) {}
};

/// The remainder for a Laplacian, whose rows sum to 0: from differences of x alone, so a constant costs no digits.
/// @param points rows to compute; `rest` is 0 elsewhere
/// @param size |b| by entry, plus what was subtracted from it before
Remainder remainderOfLaplacian(const SparseMatrix& L, const std::vector<int>& points, const Eigen::MatrixXd& b,
                               const Eigen::MatrixXd& size, const Eigen::MatrixXd& x);

/// The remainder for a Laplacian after relaxing (Gauss-Seidel) the rows whose backward error exceeds `bound`, without a
/// solve. These are rows where x is small beside its largest value, so that its last digits are wrong, and pinned rows,
/// which collect the rounding of all others.
/// @param[in,out] x changes by little more than rounding
Remainder relaxLaplacian(const SparseMatrix& L, const std::vector<int>& points, const Eigen::MatrixXd& b,
                         const Eigen::MatrixXd& size, double bound, Eigen::MatrixXd& x);

/// The remainder for any symmetric matrix.
Remainder remainderOf(const LongMatrix& lower, const Eigen::MatrixXd& b, const Eigen::MatrixXd& x);

/// The backward error of a given remainder.
/// @param A N x N, symmetric
/// @param rest N x c; rows of zeros are ignored
/// @param x N x c; NaN counts as 0
double backwardError(const SparseMatrix& A, const Eigen::MatrixXd& rest, const Eigen::MatrixXd& b,
                     const Eigen::MatrixXd& x);

}  // namespace tufted
