#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "algorithms/connected.h"
#include "tufted/interpolation.h"

namespace tufted {

/// Pins transferred to the active points, and the points that they leave free.
struct PinnedSystem {
  Components components;
  std::vector<std::uint8_t> pinned;  ///< N; 1 at points with a value, also those that are not active
  std::vector<std::uint8_t> free;    ///< N; 1 at active points without one, in components that have pins
  Eigen::MatrixXd values;            ///< N x c; the pins, NaN elsewhere
  Eigen::MatrixXd means;             ///< mean of the pins, by component
};

/// Checks pins and transfers them to the active points.
/// @param function to be named in errors
/// @throws InvalidInput
PinnedSystem pinnedSystem(const std::string& function, const Laplacian& laplacian, const Pins& pins);

/// The row of A u at point i, from differences of u alone: for matrices whose rows sum to 0 a constant costs no digits.
inline Eigen::RowVectorXd rowOfDifferences(const SparseMatrix& A, const Eigen::MatrixXd& u, int i) {
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(u.cols());
  for (SparseMatrix::InnerIterator entry(A, i); entry; ++entry) {
    // A link of no weight may lead to where nothing is pinned and u is NaN.
    if (entry.row() != i && !u.row(entry.row()).hasNaN()) sum += entry.value() * (u.row(entry.row()) - u.row(i));
  }
  return sum;
}

}  // namespace tufted
