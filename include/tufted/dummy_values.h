#pragma once

#include <vector>

#include "tufted/memory_layout.h"
#include "tufted/types.h"

namespace tufted {

/// Gives L and M full rank, for programs that expect it: every point that is not active gets 1 on the diagonal of L and
/// dummyMass() in M. The paper's program writes the same. Does nothing where all points are active.
/// @param L N x N, with empty rows and columns at points that are not active
/// @param M N areas
/// @param status N, as Laplacian::status
/// @throws InvalidInput for arrays of different sizes
void setDummyValues(SparseMatrix& L, VectorXd& M, const std::vector<PointStatus>& status);

/// A thousandth of the smallest positive mass, 1 if there is none.
double dummyMass(const VectorXd& M);

}  // namespace tufted
