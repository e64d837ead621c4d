#pragma once

#include <cstdint>
#include <vector>

#include "tufted/types.h"

namespace tufted {

/// Numbers sets of points by descending size; among equal ones the set with the lowest index comes first.
/// @param[in,out] set N; in: the same number in [0, N) for all points of a set, -1 for points in no set; out: the
/// number of the set, or -1
void numberComponents(std::vector<int>& set);

/// The connected component of each point in the graph of L, numbered as in Laplacian::component; -1 at points without a
/// row.
std::vector<int> componentsOf(const SparseMatrix& L);

/// The number of connected components of the graph of L among points that have a row.
std::int64_t countComponents(const SparseMatrix& L);

}  // namespace tufted
