#pragma once

#include <vector>

#include "tufted/detail/memory_layout.h"
#include "tufted/types.h"

namespace tufted {

/// Gives L and M full rank, for programs that expect it: sets 1 on the diagonal of L and dummyMass() in M at every
/// point that is not active, as the paper's program does. Does nothing if all points are active.
/// @param L N x N, with empty rows and columns at points that are not active
/// @param M N areas in length^2
/// @param status N, see Laplacian::status
/// @throws InvalidInput for arrays of different sizes
void setDummyValues(SparseMatrix& L, VectorXd& M, const std::vector<PointStatus>& status);

/// The mass for setDummyValues(): a thousandth of the smallest positive mass in M, and at least the smallest normal
/// double; 1 if none is positive.
double dummyMass(const VectorXd& M);

}  // namespace tufted
