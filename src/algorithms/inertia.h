#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "tufted/types.h"

namespace tufted {

/// The number of eigenvalues of L x = lambda diag(mass) x below a bound that is not an eigenvalue: the negative pivots
/// of L - bound diag(mass), by Sylvester's law of inertia. Takes a factorisation.
/// @param points rows and columns that are used, ascending
/// @param memory_limit bytes that the factor may take
/// @return nullopt if the factor is too large or a pivot is 0
std::optional<Eigen::Index> eigenvaluesBelow(const SparseMatrix& L, const VectorXd& mass, double bound,
                                             const std::vector<int>& points, std::size_t memory_limit);

}  // namespace tufted
