#pragma once

#include <optional>

#include "algorithms/eigenproblem.h"

namespace tufted {

/// The smallest positive eigenpairs by dense matrices of the active points: of diag(mass)^-1/2 S diag(mass)^-1/2, S the
/// Schur complement of L after points without mass. Takes up to 24 bytes per pair of points, and cannot be interrupted.
/// Nothing where masses are so uneven that the matrix overflows.
std::optional<Eigenpairs> densePairs(const Eigenproblem& problem, Eigen::Index wanted);

}  // namespace tufted
