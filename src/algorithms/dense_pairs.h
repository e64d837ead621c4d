#pragma once

#include <optional>

#include "algorithms/eigenproblem.h"

namespace tufted {

/// Finds the smallest positive eigenpairs by dense matrices of the active points, as those of
/// diag(mass)^-1/2 S diag(mass)^-1/2, S the Schur complement of L after points without mass are eliminated. Takes up to
/// 24 bytes per pair of points, and cannot be interrupted. Returns nullopt if masses are so uneven that the matrix
/// overflows.
std::optional<Eigenpairs> densePairs(const Eigenproblem& problem, Eigen::Index wanted);

}  // namespace tufted
