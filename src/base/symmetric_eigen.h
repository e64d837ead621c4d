#pragma once

#include <Eigen/Eigenvalues>

// Each returns eigenvalues in ascending order and orthonormal eigenvectors. Only the lower half of the matrix is read.
// Eigen's solver takes up to ten seconds to compile for each size, so it is compiled in one file alone.
namespace tufted {

Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> symmetricEigen(const Eigen::Matrix2d& matrix);
Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> symmetricEigen(const Eigen::Matrix3d& matrix);
Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> symmetricEigen(const Eigen::MatrixXd& matrix);

}  // namespace tufted
