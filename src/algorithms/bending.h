#pragma once

#include <algorithm>

#include "algorithms/connected.h"
#include "tufted/laplacian.h"

namespace tufted {

/// Where something is divided by a mass, masses below this part of the mean of their component count as that much,
/// since a zero area would bend nothing.
constexpr double least_mass_of_bending = 1e-9;

/// The mean mass of each component.
inline VectorXd meanMasses(const Laplacian& laplacian, const Components& components) {
  return components.sums(laplacian.M).cwiseQuotient(components.sums(VectorXd::Ones(laplacian.M.size())));
}

/// The mean mass of its component over the mass of each active point, N; 0 elsewhere.
inline VectorXd inverseMasses(const Laplacian& laplacian, const Components& components) {
  const VectorXd means = meanMasses(laplacian, components);
  VectorXd inverse = VectorXd::Zero(laplacian.M.size());
  for (const int i : components.points) {
    const double mean = means[components.of[i]];
    inverse[i] = mean > 0 ? 1 / std::max(laplacian.M[i] / mean, least_mass_of_bending) : 1;
  }
  return inverse;
}

/// L M^-1 L, in 1 / mean mass of each component.
/// @param inverse as inverseMasses()
inline SparseMatrix bendingMatrix(const SparseMatrix& L, const VectorXd& inverse) {
  const SparseMatrix scaled = inverse.asDiagonal() * L;
  return SparseMatrix(L * scaled);
}

}  // namespace tufted
