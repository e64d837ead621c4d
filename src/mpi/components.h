#pragma once

#include <mpi.h>

#include <cstddef>
#include <vector>

#include "tufted/mpi/distributed_laplacian.h"

namespace tufted {

/// Finds `component` and `components` of a result that has M. Collective.
/// @param begin, column the rows of L of this process, with columns by row of L
void findComponents(MPI_Comm comm, const std::vector<std::size_t>& begin, const std::vector<PetscInt>& column,
                    DistributedLaplacian& result);

}  // namespace tufted
