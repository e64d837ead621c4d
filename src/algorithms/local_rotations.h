#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/parallel.h"
#include "tufted/types.h"

namespace tufted {

/// The rotation of each neighbourhood that comes nearest to how it was deformed (Sorkine and Alexa 2007, Section 2.1):
/// R_i for which the sum over neighbours j of -L_ij |(x'_i - x'_j) - R_i (x_i - x_j)|^2 is the least.
/// @param x,moved N x 3; rows of points without a row in L do not matter
/// @return N rotations, the identity for points without neighbours
std::vector<Eigen::Matrix3d> localRotations(const SparseMatrix& L, const Eigen::MatrixXd& x,
                                            const Eigen::MatrixXd& moved, const Workers& workers);

}  // namespace tufted
