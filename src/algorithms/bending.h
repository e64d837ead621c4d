#pragma once

#include <algorithm>
#include <vector>

#include "tufted/laplacian.h"

namespace tufted {

/// Masses below this part of the mean count as that much where they are divided by: zero areas would bend nothing.
constexpr double least_mass_of_bending = 1e-9;

/// The mean mass of the active points.
inline double meanMass(const Laplacian& laplacian, const std::vector<int>& active) {
  return laplacian.M.sum() / static_cast<double>(std::max<std::size_t>(active.size(), 1));
}

/// The mean mass over the mass of each active point, N; 0 elsewhere.
inline VectorXd inverseMasses(const Laplacian& laplacian, const std::vector<int>& active) {
  const double mean = meanMass(laplacian, active);
  VectorXd inverse = VectorXd::Zero(laplacian.M.size());
  for (const int i : active) inverse[i] = mean > 0 ? 1 / std::max(laplacian.M[i] / mean, least_mass_of_bending) : 1;
  return inverse;
}

/// L M^-1 L, in 1 / mean mass.
/// @param inverse as inverseMasses()
inline SparseMatrix bendingMatrix(const SparseMatrix& L, const VectorXd& inverse) {
  const SparseMatrix scaled = inverse.asDiagonal() * L;
  return SparseMatrix(L * scaled);
}

}  // namespace tufted
