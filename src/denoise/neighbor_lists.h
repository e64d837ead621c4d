#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/buffer.h"
#include "base/point_buffer.h"
#include "denoise/windows.h"
#include "neighbors/neighbors.h"

namespace tufted {

/// The neighbours of the middles of windows, kept for all who ask for them later: a search takes longer than most of
/// what is done with what it finds.
class NeighborLists {
 public:
  explicit NeighborLists(int windows) : places_(static_cast<std::size_t>(windows)) {}

  /// Room for `count` more blocks, each of which one thread fills.
  /// @returns the number of the first of them
  int addBlocks(std::int64_t count) {
    const auto first = static_cast<int>(blocks_.size());
    blocks_.resize(blocks_.size() + static_cast<std::size_t>(count));
    return first;
  }

  /// Room in a block for so many neighbours.
  void reserve(int block, std::size_t neighbors) {
    blocks_[block].ranks.reserve(neighbors);
    blocks_[block].skipped.reserve(neighbors);
  }

  /// @param neighbors ascending
  /// @param left_out of each, whether it is left out, as WindowNeighbors has it
  void put(int block, int w, std::span<const Neighbor> neighbors, std::span<const std::uint8_t> left_out) {
    auto& [ranks, skipped] = blocks_[block];
    places_[w] = {block, static_cast<int>(ranks.size()), static_cast<int>(neighbors.size())};
    for (const Neighbor& q : neighbors) ranks.push_back(q.index);
    skipped.insert(skipped.end(), left_out.begin(), left_out.end());
  }

  /// Keeps which neighbours of a window are left out now.
  void skip(int w, std::span<const std::uint8_t> skipped) {
    const Place& place = places_[w];
    std::copy(skipped.begin(), skipped.end(), blocks_[place.block].skipped.begin() + place.start);
  }

  /// Ranks of the neighbours, ascending in distance; none of windows that were not put in.
  std::span<const int> of(int w) const {
    const Place& place = places_[w];
    if (place.count == 0) return {};
    return std::span<const int>(blocks_[place.block].ranks).subspan(place.start, place.count);
  }

  /// Whether each of the neighbours that of() gives is left out.
  std::span<const std::uint8_t> skippedOf(int w) const {
    const Place& place = places_[w];
    if (place.count == 0) return {};
    return std::span<const std::uint8_t>(blocks_[place.block].skipped).subspan(place.start, place.count);
  }

  /// Calls visit(w, neighbors) for each window w of a list, with the `count(w)` nearest of its middle.
  template <class Count, class Visit>
  void forEach(const PointsView& points, const Windows& windows, std::span<const int> which, const Count& count,
               const Visit& visit) const {
    Buffer<Neighbor> neighbors;
    for (const int w : which) {
      std::span<const int> ranks = of(w);
      ranks = ranks.first(std::min(ranks.size(), static_cast<std::size_t>(count(w))));
      neighbors.clear();
      for (const int q : ranks)
        neighbors.push_back({(points.row(q) - points.row(windows.pointOf(w))).squaredNorm(), q});
      visit(w, std::span<const Neighbor>(neighbors));
    }
  }

 private:
  struct Place {
    int block = 0, start = 0, count = 0;
  };

  struct Block {
    Buffer<int> ranks;
    Buffer<std::uint8_t> skipped;
  };

  Buffer<Place> places_;
  Buffer<Block> blocks_;
};

}  // namespace tufted
