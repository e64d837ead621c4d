#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <type_traits>

#include "base/buffer.h"
#include "base/parallel.h"

namespace tufted {

/// Edges between distinct points get at least this length, in a unit in which the median spread of the points is about
/// 1, so that what is computed from lengths does not underflow.
constexpr double shortest = 0x1p-250;

/// Makes every edge at least `delta` times as long as the longest side of the smaller of its two faces (section 10 of
/// docs/algorithm.md, step 1; instead of Section 4.5 of the paper). No triangle inequality breaks.
/// @param cover with lengths in double or long double
/// @returns the number of edges that were lengthened
template <class Triangulation>
std::int64_t lengthenShortEdges(Triangulation& cover, double delta, const Workers& workers) {
  using Real = std::decay_t<decltype(cover.length[0])>;
  Buffer<Real> longest(static_cast<std::size_t>(cover.size()));  // longest side of each face
  workers.forBlocks("mollify", cover.size(), cheapest_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t f = begin; f < end; ++f)
      longest[f] = std::max({cover.length[3 * f], cover.length[3 * f + 1], cover.length[3 * f + 2]});
  });
  std::atomic<std::int64_t> lengthened = 0;
  workers.forBlocks("mollify", cover.size(), cheapest_block, [&](std::int64_t begin, std::int64_t end, int) {
    std::int64_t here = 0;
    for (std::int64_t side = 3 * begin; side < 3 * end; ++side) {
      const Real own = longest[side / 3], other = longest[cover.glue[side] / 3];
      // The smaller face decides, because many long faces may end at a small part of a mesh. A face whose sides are all
      // 0 does not count.
      Real least = delta * (std::min(own, other) > 0 ? std::min(own, other) : std::max(own, other));
      if (cover.length[side] > 0) least = std::max<Real>(least, shortest);
      if (cover.length[side] >= least) continue;
      cover.length[side] = least;
      ++here;
    }
    lengthened += here;
  });
  return lengthened / 2;
}

}  // namespace tufted
