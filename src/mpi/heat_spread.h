#pragma once

#include <cstdint>
#include <vector>

#include "mpi/ghosts.h"
#include "tufted/mpi/distributed_laplacian.h"

namespace tufted {

/// Solves (D + L) u = heat for u, whose logarithm is accurate everywhere, though u itself, which falls to a third with
/// every edge, would soon underflow. Rows are found from the sources outwards, in rounds: each solves for a window
/// of rows ahead, given the heat of those that were found, and keeps those whose heat is far above the error of
/// conjugate gradients. Collective.
/// @param rows all columns of L in the rows of this process
/// @param diagonal of D, >= 0, of the rows of this process
/// @param is_source by row of this process, whether its heat is 1; others have none
/// @param is_cold by row of this process, whether u is 0 there
/// @return ln u of all of `rows`; -infinity where u is 0
std::vector<double> logOfHeat(const DistributedLaplacian& laplacian, const Ghosts& rows,
                              const std::vector<double>& diagonal, const std::vector<std::uint8_t>& is_source,
                              const std::vector<std::uint8_t>& is_cold);

}  // namespace tufted
