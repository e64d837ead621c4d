#include "base/dense_solvers.h"

#include <Eigen/QR>

namespace tufted {

using Eigen::MatrixXd;

DenseCholesky::DenseCholesky(const MatrixXd& A) : factor_(A) {}

MatrixXd DenseCholesky::solve(const MatrixXd& B) const {
  return factor_.solve(B);
}

MatrixXd DenseCholesky::inverseOfUpper() const {
  return factor_.matrixU().solve(MatrixXd::Identity(factor_.cols(), factor_.cols()));
}

MatrixXd leastSquares(const MatrixXd& A, const MatrixXd& B) {
  return A.completeOrthogonalDecomposition().solve(B);
}

}  // namespace tufted
