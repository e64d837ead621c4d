#pragma once

#include <array>
#include <optional>
#include <vector>

#include "bench/compare/rivals.h"

// Solves that also work for matrices that are not symmetric, not definite or have several components.

namespace tufted::bench {

/// The eigenvalues of L x = lambda M x nearest to 0, as far as there are.
struct Eigenvalues {
  VectorXd values;   ///< real parts, ascending
  int complex = 0;   ///< of these, how many have an imaginary part
  int negative = 0;  ///< of these, how many have a negative real part
};
/// Computes eigenvalues by shift-and-invert: block Lanczos of the library for positive semidefinite matrices, Spectra's
/// Arnoldi iteration with a sparse LU for others. Points with an empty row are left out.
/// @throws std::runtime_error if that fails
Eigenvalues eigenvaluesOf(const Operators& operators, bool symmetric, int count);

/// Values that are given at some points.
struct Pinned {
  std::vector<int> points;
  Eigen::MatrixXd values;  ///< one row per point
};
/// Solves L u = f away from pins. Rows of components without a pin are NaN.
/// @param seconds set to the time of factor and solve
/// @return nothing if L has no factor
std::optional<Eigen::MatrixXd> solvePinned(const SparseMatrix& L, bool symmetric, const Eigen::MatrixXd& f,
                                           const Pinned& pins, std::array<double, 2>* seconds = nullptr);

/// The share of off-diagonal entries of L that are positive by more than rounding.
double positiveShare(const SparseMatrix& L);

}  // namespace tufted::bench
