#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "base/buffer.h"
#include "base/point_buffer.h"
#include "denoise/windows.h"
#include "neighbors/batched_search.h"

namespace tufted {

/// Searches for neighbours of listed points; memory of one worker.
class ListedSearch {
 public:
  /// All arguments are borrowed.
  ListedSearch(const PointsView& points, const NeighborSearch& search, const Windows& windows)
      : points_(points), search_(search), windows_(windows) {}

  /// Calls visit(p, neighbors) for each point p of a list, with its `count(p)` nearest as by NeighborSearch::nearest.
  /// Points that follow each other are searched for together.
  /// @param which ascending
  template <class Count, class Visit>
  void forEach(std::span<const int> which, const Count& count, const Visit& visit) {
    for (std::size_t begin = 0, end = 0; begin < which.size(); begin = end) {
      const int first = which[begin], k = count(first);
      // Others between them are searched for as well, where these are not too many.
      while (++end < which.size() && which[end] - first < most_together && count(which[end]) == k)
        if (which[end] - first >= 2 * static_cast<int>(end - begin + 1)) break;
      find(first, which[end - 1] - first + 1, k);
      for (std::size_t i = begin; i < end; ++i)
        visit(which[i],
              std::span<const Neighbor>(found_).subspan(static_cast<std::size_t>(which[i] - first) * row_, row_));
    }
  }

 private:
  static constexpr int most_together = 32;

  void find(int first, int count, int k) {
    row_ = static_cast<std::size_t>(std::min(k, windows_.size() - 1));
    const double radius = windows_.radius[first] * std::sqrt(static_cast<double>(k) / windows_.base[first]);
    nearestOfEach(search_, points_, first, count, k, kernels(), scratch_, found_, radius);
  }

  PointsView points_;
  const NeighborSearch& search_;
  const Windows& windows_;
  BatchScratch scratch_;
  Buffer<Neighbor> found_;
  std::size_t row_ = 0;  ///< neighbours of each point
};

}  // namespace tufted
