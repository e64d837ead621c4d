#pragma once

#include <Eigen/Cholesky>

// Solvers of Eigen for dense matrices of any size. Each takes five to fifteen seconds to compile, so they are compiled
// in one file alone.
namespace tufted {

/// The Cholesky factor of a symmetric matrix A, of which the lower half is read.
class DenseCholesky {
 public:
  DenseCholesky() = default;
  explicit DenseCholesky(const Eigen::MatrixXd& A);

  /// Whether A is positive definite; otherwise nothing else may be called.
  bool isDefinite() const { return factor_.info() == Eigen::Success; }
  /// X with A X = B.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& B) const;
  /// The diagonal of the upper triangular factor U, A = U^T U.
  Eigen::VectorXd diagonal() const { return factor_.matrixLLT().diagonal(); }
  /// The inverse of U: the columns of X U^-1 are orthonormal if A = X^T X.
  Eigen::MatrixXd inverseOfUpper() const;

 private:
  Eigen::LLT<Eigen::MatrixXd> factor_;
};

/// The matrix X of least norm that minimises |A X - B|.
/// @param A m x n, of any rank
/// @param B m x c
/// @return n x c
Eigen::MatrixXd leastSquares(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

}  // namespace tufted
