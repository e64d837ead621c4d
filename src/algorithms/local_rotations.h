#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/parallel.h"
#include "tufted/types.h"

namespace tufted {

/// The rotation R with the least sum over edges of w |e' - R e|^2 (Sorkine and Alexa 2007, Section 2.1).
/// @param products the sum of w e' e^T
/// @return the identity if `products` is 0
Eigen::Matrix3d nearestRotation(const Eigen::Matrix3d& products);

/// The `products` of nearestRotation() for the edges x_i - x_j from a point to its neighbours, weighted by -L_ij.
/// @param x,moved N x 3; rows of points without a row in L do not matter
Eigen::Matrix3d edgeProducts(const SparseMatrix& L, const Eigen::MatrixXd& x, const Eigen::MatrixXd& moved, int i);

/// The rotation of each point's neighbourhood that is nearest to its deformation.
/// @param x,moved N x 3; positions before and after
/// @return N rotations, the identity for points without neighbours
std::vector<Eigen::Matrix3d> localRotations(const SparseMatrix& L, const Eigen::MatrixXd& x,
                                            const Eigen::MatrixXd& moved, const Workers& workers);

}  // namespace tufted
