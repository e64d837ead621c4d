#pragma once

#include <cstdint>
#include <vector>

#include "tufted/types.h"

namespace tufted {

/// The rings of neighbours in L around one point at a time. Reused for many points.
class Rings {
 public:
  /// @param L borrowed
  explicit Rings(const SparseMatrix& L) : L_(L), seen_(L.cols(), 0) {}

  void start(int p) {
    points_.assign(1, p);
    count_ = 0;
    seen_[p] = ++start_;
    ring_begin_ = 0;
  }

  /// Adds the next ring. False if there is none.
  bool grow() {
    ++count_;
    const std::size_t ring_end = points_.size();
    for (; ring_begin_ < ring_end; ++ring_begin_) {
      for (SparseMatrix::InnerIterator entry(L_, points_[ring_begin_]); entry; ++entry) {
        const auto q = static_cast<int>(entry.row());
        if (seen_[q] == start_) continue;
        seen_[q] = start_;
        points_.push_back(q);
      }
    }
    return points_.size() > ring_end;
  }

  /// Number of calls of grow() since start().
  int count() const { return count_; }
  /// The point itself, then its rings in order.
  const std::vector<int>& points() const { return points_; }

 private:
  const SparseMatrix& L_;
  std::vector<std::int64_t> seen_;  ///< number of the last start() that has reached the point
  std::vector<int> points_;
  std::size_t ring_begin_ = 0;
  std::int64_t start_ = 0;
  int count_ = 0;
};

}  // namespace tufted
