#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "operators/lower_triangle.h"
#include "tufted/types.h"

namespace tufted {

/// The remainder b - A x of a solution x, and how it compares with what rounding explains.
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
/// @param points rows to be looked at; `rest` is 0 elsewhere
/// @param size |b| by entry, as it was before something was taken out of it
Remainder remainderOfLaplacian(const SparseMatrix& L, const std::vector<int>& points, const Eigen::MatrixXd& b,
                               const Eigen::MatrixXd& size, const Eigen::MatrixXd& x);

/// The remainder for a Laplacian after single rows that are worse than `bound` are relaxed (Gauss-Seidel), which takes
/// no solve. Such rows are those where x is small beside its largest value, so that its last digits are wrong, and
/// those where x was pinned, so that all rows' rounding has gathered.
/// @param x changes by very little
Remainder relaxLaplacian(const SparseMatrix& L, const std::vector<int>& points, const Eigen::MatrixXd& b,
                         const Eigen::MatrixXd& size, double bound, Eigen::MatrixXd& x);

/// The remainder for any symmetric matrix.
Remainder remainderOf(const LongMatrix& lower, const Eigen::MatrixXd& b, const Eigen::MatrixXd& x);

/// The backward error of a given remainder, however that was found.
/// @param A N x N, symmetric
/// @param rest N x c; rows of zeros are ignored
/// @param x N x c; NaN counts as 0
double backwardError(const SparseMatrix& A, const Eigen::MatrixXd& rest, const Eigen::MatrixXd& b,
                     const Eigen::MatrixXd& x);

}  // namespace tufted
