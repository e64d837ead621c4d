#pragma once

#include "algorithms/eigenproblem.h"
#include "base/parallel.h"

namespace tufted {

/// Makes eigenpairs, values and vectors, as exact as rounding lets them be. The inverse of L is exact to a part of its
/// largest eigenvalue, L to a part of its own. So pairs of small eigenvalues are refined by the inverse, all others by
/// L.
/// @param mixed each vector may hold parts of the others, however far their eigenvalues are apart
/// @return whether the vectors are independent, without which the pairs mean nothing
bool refinePairs(const Eigenproblem& problem, const InverseTimes& inverse, bool mixed, const Workers& workers,
                 Eigenpairs& pairs);

}  // namespace tufted
