#include "algorithms/local_rotations.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cstdint>

namespace tufted {

Eigen::Matrix3d nearestRotation(const Eigen::Matrix3d& products) {
  const double size = products.cwiseAbs().maxCoeff();
  if (!(size > 0)) return Eigen::Matrix3d::Identity();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(products / size, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  // Against a reflection, the direction of the least singular value is reversed: nearly the normal.
  if (u.determinant() * svd.matrixV().determinant() < 0) u.col(2) *= -1;
  return u * svd.matrixV().transpose();
}

Eigen::Matrix3d edgeProducts(const SparseMatrix& L, const Eigen::MatrixXd& x, const Eigen::MatrixXd& moved, int i) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (SparseMatrix::InnerIterator entry(L, i); entry; ++entry) {
    const auto j = entry.row();
    if (j != i) sum -= entry.value() * (moved.row(i) - moved.row(j)).transpose() * (x.row(i) - x.row(j));
  }
  return sum;
}

std::vector<Eigen::Matrix3d> localRotations(const SparseMatrix& L, const Eigen::MatrixXd& x,
                                            const Eigen::MatrixXd& moved, const Workers& workers) {
  std::vector<Eigen::Matrix3d> rotations(static_cast<std::size_t>(x.rows()));
  workers.forBlocks("rotations", x.rows(), star_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (auto i = static_cast<int>(begin); i < end; ++i) rotations[i] = nearestRotation(edgeProducts(L, x, moved, i));
  });
  return rotations;
}

}  // namespace tufted
