#pragma once

#include <cstdint>
#include <vector>

#include "tufted/types.h"

namespace tufted {

/// Numbers sets of points by their size, the largest first, and of equal ones that of the lowest index.
/// @param[in,out] set N; any number in [0, N) that is the same for all points of a set, or -1: in none; then the
/// number of the set
void numberComponents(std::vector<int>& set);

/// The connected components of the graph of L, as Laplacian::component has them; -1 at points without a row.
std::vector<int> componentsOf(const SparseMatrix& L);

/// Connected components of the graph of L among rows with a positive diagonal.
std::int64_t countComponents(const SparseMatrix& L);

}  // namespace tufted
