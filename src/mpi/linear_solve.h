#pragma once

#include <petscmat.h>

#include "tufted/mpi/solves.h"

// Linear systems on several processes. All functions are collective.

namespace tufted {

/// The greatest magnitude of an entry.
double greatestOf(Vec vector);

/// Subtracts the mean of each component, weighted by M.
void subtractMeans(const DistributedLaplacian& laplacian, Vec vector);

/// Solves A u = b for a positive definite A, and checks the residual. @param[in,out] u the first guess, replaced
/// @throws SolverFailure in the name of `function`
void solveDefinite(const char* function, Mat A, Vec b, Vec u, DistributedSolve* report);

/// Solves L u = b, and checks the residual; u has mean 0 on each component.
/// @param b sums to 0 over each component
/// @param[in,out] u the first guess, replaced
/// @throws SolverFailure in the name of `function`
void solveLaplacian(const char* function, const DistributedLaplacian& laplacian, Vec b, Vec u,
                    DistributedSolve* report);

}  // namespace tufted
