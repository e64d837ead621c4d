#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "tufted/laplacian.h"

namespace tufted::support {

/// Permutes points: row i of the result is row `source[i]` of `points`.
inline Points permuted(const Points& points, const std::vector<int>& source) {
  Points result(points.rows(), 3);
  for (Eigen::Index i = 0; i < points.rows(); ++i) result.row(i) = points.row(source[i]);
  return result;
}

inline double meanError(const VectorXd& distance, const VectorXd& exact) {
  return (distance - exact).cwiseAbs().sum() / exact.sum();
}

inline bool sameBits(const double* a, const double* b, std::size_t count) {
  return count == 0 || std::memcmp(a, b, count * sizeof(double)) == 0;
}

inline bool sameBits(const SparseMatrix& a, const SparseMatrix& b) {
  return a.rows() == b.rows() && a.nonZeros() == b.nonZeros() &&
         std::equal(a.outerIndexPtr(), a.outerIndexPtr() + a.cols() + 1, b.outerIndexPtr()) &&
         std::equal(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros(), b.innerIndexPtr()) &&
         sameBits(a.valuePtr(), b.valuePtr(), static_cast<std::size_t>(a.nonZeros()));
}

inline bool sameBits(const VectorXd& a, const VectorXd& b) {
  return a.size() == b.size() && sameBits(a.data(), b.data(), static_cast<std::size_t>(a.size()));
}

/// Permutes a matrix: entry (i, j) of the result is L(source[i], source[j]).
inline SparseMatrix permuted(const SparseMatrix& L, const std::vector<int>& source) {
  std::vector<int> place(source.size());
  for (std::size_t i = 0; i < source.size(); ++i) place[source[i]] = static_cast<int>(i);
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < L.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator it(L, j); it; ++it) entries.emplace_back(place[it.row()], place[j], it.value());
  }
  SparseMatrix result(L.rows(), L.cols());
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

inline double largestEntry(const SparseMatrix& L) {
  double largest = 0;
  for (Eigen::Index i = 0; i < L.nonZeros(); ++i) largest = std::max(largest, std::abs(L.valuePtr()[i]));
  return largest;
}

inline double largestDifference(const SparseMatrix& a, const SparseMatrix& b) {
  return largestEntry(SparseMatrix(a - b));
}

}  // namespace tufted::support
