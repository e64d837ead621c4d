#pragma once

#include <optional>

#include "algorithms/eigenproblem.h"

namespace tufted {

/// Finds the `wanted` smallest positive eigenpairs by dense matrices, as those of diag(mass)^-1/2 S diag(mass)^-1/2,
/// where S is the Schur complement of L without the points of no mass. Takes up to 24 bytes per pair of points, and
/// cannot be cancelled. Nullopt if masses are so uneven that the matrix overflows.
std::optional<Eigenpairs> densePairs(const Eigenproblem& problem, Eigen::Index wanted);

}  // namespace tufted
