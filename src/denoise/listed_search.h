#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "base/buffer.h"
#include "base/point_buffer.h"
#include "neighbors/batched_search.h"
#include "neighbors/own_side.h"

namespace tufted {

/// Calls visit(p, neighbors) for each listed point, with those of its min(k, n - 1) nearest that are on its own side,
/// see nearestOfListed() and keepOwnSide().
/// @param points n x 3, the points that `search` was built from
/// @param normals n x 3, or 0 x 3 if not known
/// @param ranks the listed points, ascending
template <class Visit>
void forEachListed(const PointsView& points, const PointBuffer& normals, const NeighborSearch& search,
                   std::span<const int> ranks, int k, const Visit& visit) {
  // Points per search: their neighbours stay in cache.
  constexpr std::size_t together = 32;
  BatchScratch scratch;
  Buffer<Neighbor> found;
  const auto row = static_cast<std::size_t>(std::min(k, static_cast<int>(points.rows()) - 1));
  double radius = std::numeric_limits<double>::infinity();
  for (std::size_t begin = 0; begin < ranks.size(); begin += together) {
    const auto group = ranks.subspan(begin, std::min(together, ranks.size() - begin));
    nearestOfListed(search, points, group, k, kernels(), scratch, found, radius);
    // An estimate for the next points, which are close.
    if (row > 0) radius = std::sqrt(found[row - 1].squared_distance);
    for (std::size_t i = 0; i < group.size(); ++i) {
      const auto neighbors = std::span<Neighbor>(found).subspan(i * row, row);
      visit(group[i], std::span<const Neighbor>(neighbors.first(keepOwnSide(points, normals, group[i], neighbors))));
    }
  }
}

}  // namespace tufted
