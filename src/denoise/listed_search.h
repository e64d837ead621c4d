#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "base/buffer.h"
#include "base/point_buffer.h"
#include "neighbors/batched_search.h"

namespace tufted {

/// Searches for neighbours of listed points; memory of one worker.
class ListedSearch {
 public:
  /// All arguments are borrowed.
  ListedSearch(const PointsView& points, const NeighborSearch& search) : points_(points), search_(search) {}

  /// Calls visit(w, neighbors) for each number w of a list, with the `count(w)` nearest of the point of rank `rank(w)`
  /// as by NeighborSearch::nearest. Points that follow each other are searched for together.
  /// @param which whose ranks ascend
  template <class Rank, class Count, class Visit>
  void forEach(std::span<const int> which, const Rank& rank, const Count& count, const Visit& visit) {
    forEachGroup(which, rank, count, [&](std::span<const int> group, const auto& neighborsOf) {
      for (std::size_t i = 0; i < group.size(); ++i) visit(group[i], neighborsOf(i));
    });
  }

  /// Calls visit(group, neighborsOf) for numbers of one count that follow each other in the list, at most
  /// `most_together`. neighborsOf(i) are the neighbours of group[i], as forEach() has them, until visit() returns.
  template <class Rank, class Count, class Visit>
  void forEachGroup(std::span<const int> which, const Rank& rank, const Count& count, const Visit& visit) {
    std::array<int, most_together> ranks;
    for (std::size_t begin = 0, end = 0; begin < which.size(); begin = end) {
      const int k = count(which[begin]);
      for (; end < which.size() && end - begin < most_together && count(which[end]) == k; ++end)
        ranks[end - begin] = rank(which[end]);
      find(std::span(ranks).first(end - begin), k);
      visit(which.subspan(begin, end - begin),
            [&](std::size_t i) { return std::span<const Neighbor>(found_).subspan(i * row_, row_); });
    }
  }

  static constexpr std::size_t most_together = 32;  ///< points that are searched for together

 private:
  void find(std::span<const int> ranks, int k) {
    row_ = static_cast<std::size_t>(std::min(k, static_cast<int>(points_.rows()) - 1));
    // About as far as the search before had to look, which was near by.
    const double radius = last_count_ > 0 ? last_radius_ * std::sqrt(static_cast<double>(k) / last_count_)
                                          : std::numeric_limits<double>::infinity();
    nearestOfListed(search_, points_, ranks, k, kernels(), scratch_, found_, radius);
    last_count_ = k;
    last_radius_ = row_ > 0 ? std::sqrt(found_[row_ - 1].squared_distance) : 0;
  }

  PointsView points_;
  const NeighborSearch& search_;
  BatchScratch scratch_;
  Buffer<Neighbor> found_;
  std::size_t row_ = 0;  ///< neighbours of each point
  int last_count_ = 0;   ///< neighbours that were asked for last
  double last_radius_ = 0;
};

}  // namespace tufted
