#pragma once

#include <mpi.h>

#include <cstddef>
#include <vector>

#include "tufted/mpi/distributed_laplacian.h"

namespace tufted {

/// Finds `component` and `components` of a result that has M: rows are connected by entries below 0. Collective.
/// @param begin, column, value the rows of L of this process, with columns by row of L
void findComponents(MPI_Comm comm, const std::vector<std::size_t>& begin, const std::vector<PetscInt>& column,
                    const std::vector<PetscScalar>& value, DistributedLaplacian& result);

}  // namespace tufted
