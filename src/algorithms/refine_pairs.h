#pragma once

#include "algorithms/eigenproblem.h"
#include "base/parallel.h"

namespace tufted {

/// Refines eigenpairs up to rounding. The errors of L and of its inverse are parts of their own largest eigenvalues, so
/// pairs of small eigenvalues of L are refined by the inverse, all others by L.
/// @param mixed whether vectors may contain parts of others with far eigenvalues
/// @return false if the vectors are linearly dependent; the pairs are then meaningless
bool refinePairs(const Eigenproblem& problem, const InverseTimes& inverse, bool mixed, const Workers& workers,
                 Eigenpairs& pairs);

}  // namespace tufted
