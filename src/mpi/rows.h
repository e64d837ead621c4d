#pragma once

#include <petscvec.h>

#include <vector>

#include "tufted/mpi/distributed_laplacian.h"

namespace tufted {

/// The processes of a Laplacian.
MPI_Comm commOf(const DistributedLaplacian& laplacian);

/// A vector of the size and layout of another one.
PetscVector like(Vec vector);

/// The Euclidean norm.
double normOf(Vec vector);

/// Sums of values over the rows of each component. @param values of the rows of this process. Collective.
std::vector<double> sumsOf(const DistributedLaplacian& laplacian, const std::vector<double>& values);

/// The greatest value on each component, `none` where there is no row. Collective.
/// @param rows some rows of this process
/// @param values one for each
std::vector<double> greatestOfComponents(const DistributedLaplacian& laplacian, const std::vector<int>& rows,
                                         const std::vector<double>& values, double none);

/// L plus a small multiple of M: positive definite, as a preconditioner of L should be. A row without entries gets 1.
PetscMatrix definiteOf(const DistributedLaplacian& laplacian);

}  // namespace tufted
