#pragma once

#include <Eigen/SparseCore>
#include <cstdint>
#include <vector>

#include "tufted/types.h"

namespace tufted {

/// The matrix type of factorisations. The factor of a large cloud may have more than 2^31 entries.
using LongMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, std::int64_t>;

/// Numbers some of the points, in ascending order.
struct NumberedPoints {
  /// The number of points that are not selected.
  static constexpr std::int64_t left_out = -1;
  std::vector<std::int64_t> number;  ///< N; `left_out` for points not selected
  std::vector<int> point;            ///< index of the point, by number

  explicit NumberedPoints(std::size_t size) : number(size, left_out) {}
  /// Adds a point; to be called in ascending order.
  void add(int i) {
    number[i] = static_cast<std::int64_t>(point.size());
    point.push_back(i);
  }
};

/// The lower triangle of L over the selected points, each entry replaced by value(i, j, L_ij), where i and j are
/// indices in L.
template <class Value>
LongMatrix lowerTriangle(const SparseMatrix& L, const NumberedPoints& selection, const Value& value) {
  const auto n = static_cast<Eigen::Index>(selection.point.size());
  LongMatrix lower(n, n);
  lower.reserve((L.nonZeros() + n) / 2);
  for (Eigen::Index k = 0; k < n; ++k) {
    const int j = selection.point[k];
    lower.startVec(k);
    for (SparseMatrix::InnerIterator entry(L, j); entry; ++entry) {
      const auto i = static_cast<int>(entry.row());
      // Numbers ascend with indices, and `left_out` is below all of them.
      if (selection.number[i] >= k) lower.insertBack(selection.number[i], k) = value(i, j, entry.value());
    }
  }
  lower.finalize();
  return lower;
}

}  // namespace tufted
