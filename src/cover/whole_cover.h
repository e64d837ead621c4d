#pragma once

#include <algorithm>
#include <cstdint>

#include "base/buffer.h"
#include "base/parallel.h"
#include "cover/flip_edges.h"

namespace tufted {

/// A complete cover as flipEdges() takes it.
template <class Triangulation>
class WholeCover {
 public:
  WholeCover(Triangulation& cover, const Workers& workers)
      : cover_(cover), triangles_(cover.size() / 2), state_(cover.glue.size()), seeds_(blocks()) {
    workers.forBlocks("flips", triangles_, cheapest_block,
                      [&](std::int64_t begin, std::int64_t, int) { findSeeds(begin / cheapest_block); });
  }

  Triangulation& triangulation() { return cover_; }
  std::int64_t blocks() const { return (triangles_ + cheapest_block - 1) / cheapest_block; }
  SideRange sidesOf(std::int64_t first, std::int64_t last) const {
    return {static_cast<int>(6 * first * cheapest_block),
            static_cast<int>(6 * std::min(last * cheapest_block, triangles_))};
  }
  template <class Push>
  void start(std::int64_t block, const Push& push) const {
    std::for_each(seeds_[block].begin(), seeds_[block].end(), push);
  }
  bool resolve(int, const SideRange&) const { return true; }
  std::uint8_t& state(int side) { return state_[side]; }
  void flipped(int, int) {}

 private:
  /// The sides of a block that are not Delaunay at the start, in order.
  void findSeeds(std::int64_t block) {
    const SideRange sides = sidesOf(block, block + 1);
    for (int side = sides.begin; side < sides.end; ++side) {
      const int mate = cover_.glue[side];
      // An edge that is not Delaunay has an obtuse angle on at least one side.
      if (isOppositeObtuse(cover_, side) && oppositeCotan(cover_, side) + oppositeCotan(cover_, mate) < flip_below)
        seeds_[block].push_back(side);
    }
  }

  Triangulation& cover_;
  const std::int64_t triangles_;
  Buffer<std::uint8_t> state_;  ///< by side
  Buffer<Buffer<int>> seeds_;   ///< by block
};

}  // namespace tufted
