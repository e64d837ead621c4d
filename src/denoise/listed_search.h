#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "base/buffer.h"
#include "base/point_buffer.h"
#include "neighbors/batched_search.h"

namespace tufted {

/// Calls visit(p, neighbors) for each listed point, with its min(k, n - 1) nearest, see nearestOfListed().
/// @param points n x 3, the points that `search` was built from
/// @param ranks the listed points, ascending
template <class Visit>
void forEachListed(const PointsView& points, const NeighborSearch& search, std::span<const int> ranks, int k,
                   const Visit& visit) {
  // Points per search: their neighbours stay in cache.
  constexpr std::size_t together = 32;
  BatchScratch scratch;
  Buffer<Neighbor> found;
  const auto row = static_cast<std::size_t>(std::min(k, static_cast<int>(points.rows()) - 1));
  double radius = std::numeric_limits<double>::infinity();
  for (std::size_t begin = 0; begin < ranks.size(); begin += together) {
    const auto group = ranks.subspan(begin, std::min(together, ranks.size() - begin));
    nearestOfListed(search, points, group, k, kernels(), scratch, found, radius);
    for (std::size_t i = 0; i < group.size(); ++i)
      visit(group[i], std::span<const Neighbor>(found).subspan(i * row, row));
    // An estimate for the next points, which are close.
    if (row > 0) radius = std::sqrt(found[row - 1].squared_distance);
  }
}

}  // namespace tufted
