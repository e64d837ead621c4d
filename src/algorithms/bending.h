#pragma once

#include <algorithm>

#include "algorithms/connected.h"
#include "tufted/laplacian.h"

namespace tufted {

/// A divisor M_i is raised to at least this part of the mean mass of its component, as a mass of 0 would make bending
/// infinite.
constexpr double least_mass_of_bending = 1e-9;

/// The mean mass of each component.
inline VectorXd meanMasses(const Laplacian& laplacian, const Components& components) {
  return components.sums(laplacian.M).cwiseQuotient(components.sums(VectorXd::Ones(laplacian.M.size())));
}

/// N; the mean mass of the component over the mass of each active point, 0 at others.
inline VectorXd inverseMasses(const Laplacian& laplacian, const Components& components) {
  const VectorXd means = meanMasses(laplacian, components);
  VectorXd inverse = VectorXd::Zero(laplacian.M.size());
  for (const int i : components.points) {
    const double mean = means[components.of[i]];
    inverse[i] = mean > 0 ? 1 / std::max(laplacian.M[i] / mean, least_mass_of_bending) : 1;
  }
  return inverse;
}

/// The matrix L M^-1 L of the bending energy, in units of 1 / mean mass of each component.
/// @param inverse result of inverseMasses()
inline SparseMatrix bendingMatrix(const SparseMatrix& L, const VectorXd& inverse) {
  const SparseMatrix scaled = inverse.asDiagonal() * L;
  return SparseMatrix(L * scaled);
}

}  // namespace tufted
