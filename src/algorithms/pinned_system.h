#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "algorithms/connected.h"
#include "tufted/interpolation.h"

namespace tufted {

/// The active points that are pinned, and those that are free.
struct PinnedPoints {
  Components components;
  std::vector<std::uint8_t> pinned;  ///< N; 1 at representatives of pins, active or not
  std::vector<std::uint8_t> free;    ///< N; 1 at active points without a pin, in components with pins
};

/// Values of pins, transferred to representatives.
struct PinnedValues {
  Eigen::MatrixXd values;  ///< N x c; the mean of all pins at a place, NaN elsewhere
  Eigen::MatrixXd means;   ///< components x c; means over the pins
};

/// Checks the points of pins and replaces them by their representatives.
/// @param function named in errors
/// @param what name of `points` in errors
/// @throws InvalidInput for an index out of range, or no pin at an active point
PinnedPoints pinnedPoints(const std::string& function, const Laplacian& laplacian, const std::vector<int>& points,
                          const std::string& what = "pins.points");

/// Checks the values of pins.
/// @throws InvalidInput for values of the wrong size or not finite
void checkPinnedValues(const std::string& function, const std::vector<int>& points, const Eigen::MatrixXd& values);

/// Transfers checked values of pins to representatives; pins at one place are averaged.
/// @param pinned result of pinnedPoints() for `points`
PinnedValues pinnedValues(const Laplacian& laplacian, const PinnedPoints& pinned, const std::vector<int>& points,
                          const Eigen::MatrixXd& values);

/// Row i of A u from differences of u, for matrices whose rows sum to 0: a large mean of u costs no digits.
inline Eigen::RowVectorXd rowOfDifferences(const SparseMatrix& A, const Eigen::MatrixXd& u, int i) {
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(u.cols());
  for (SparseMatrix::InnerIterator entry(A, i); entry; ++entry) {
    // A weight too small to join may lead to a component without pins, where u is NaN.
    if (entry.row() != i && !u.row(entry.row()).hasNaN()) sum += entry.value() * (u.row(entry.row()) - u.row(i));
  }
  return sum;
}

}  // namespace tufted
