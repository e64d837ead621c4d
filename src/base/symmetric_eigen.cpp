#include "base/symmetric_eigen.h"

namespace tufted {

Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> symmetricEigen(const Eigen::Matrix2d& matrix) {
  // In closed form; the general way would take eight seconds to compile.
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver;
  solver.computeDirect(matrix);
  return solver;
}

Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> symmetricEigen(const Eigen::Matrix3d& matrix) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(matrix);
}

Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> symmetricEigen(const Eigen::MatrixXd& matrix) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix);
}

}  // namespace tufted
