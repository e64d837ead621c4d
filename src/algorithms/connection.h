#pragma once

#include <Eigen/Core>

#include "tufted/laplacian.h"

namespace tufted {

/// Parallel transport between tangent planes, in the coordinates of the frames: the smallest rotation that takes the
/// plane of point `from` to that of point `to`. If their normals point to different sides, one is negated first, and
/// the determinant is -1.
Eigen::Matrix2d transportBetween(const Frames& frames, int from, int to);

/// The connection Laplacian (Sharp, Soliman, Crane 2019, Section 3.2), 2N x 2N: rows and columns 2i and 2i + 1 belong
/// to the frame of point i, and each L_ij is multiplied by transportBetween(frames, j, i). Symmetric, positive
/// semidefinite.
SparseMatrix connectionLaplacian(const SparseMatrix& L, const Frames& frames);

}  // namespace tufted
