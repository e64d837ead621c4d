#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "algorithms/connected.h"
#include "tufted/interpolation.h"

namespace tufted {

/// Which of the active points are pinned, and which are left free.
struct PinnedPoints {
  Components components;
  std::vector<std::uint8_t> pinned;  ///< N; 1 at points with a value, also those that are not active
  std::vector<std::uint8_t> free;    ///< N; 1 at active points without one, in components that have pins
};

/// Values of pins transferred to the active points.
struct PinnedValues {
  Eigen::MatrixXd values;  ///< N x c; the pins, NaN elsewhere
  Eigen::MatrixXd means;   ///< mean of the pins, by component
};

/// Checks the points of pins and transfers them to the active points.
/// @param function to be named in errors
/// @param what the points are called there
/// @throws InvalidInput
PinnedPoints pinnedPoints(const std::string& function, const Laplacian& laplacian, const std::vector<int>& points,
                          const std::string& what = "pins.points");

/// Checks the values of pins.
/// @throws InvalidInput
void checkPinnedValues(const std::string& function, const std::vector<int>& points, const Eigen::MatrixXd& values);

/// Transfers values of pins, which were checked, to the active points.
/// @param pinned of these points
PinnedValues pinnedValues(const Laplacian& laplacian, const PinnedPoints& pinned, const std::vector<int>& points,
                          const Eigen::MatrixXd& values);

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
