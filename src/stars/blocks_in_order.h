#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <utility>

#include "base/buffer.h"
#include "stars/stars.h"

namespace tufted {

/// The stars of one block of points.
struct BlockOfStars {
  Buffer<int> link;
  Buffer<std::uint8_t> triangle;
  Buffer<double> radius;

  void reserve(std::int64_t points) {
    const auto usual = static_cast<std::size_t>(7 * points);  // mean number of link vertices
    link.reserve(usual);
    triangle.reserve(usual);
    radius.reserve(usual);
  }
  void appendTo(BuiltStars& built) const {
    built.stars.link.insert(built.stars.link.end(), link.begin(), link.end());
    built.stars.triangle.insert(built.stars.triangle.end(), triangle.begin(), triangle.end());
    built.support.radius.insert(built.support.radius.end(), radius.begin(), radius.end());
  }
  void clear() {
    link.clear();
    triangle.clear();
    radius.clear();
  }
};

/// Appends the stars of blocks in the order of the blocks, in whatever order the threads finish them.
class BlocksInOrder {
 public:
  BlocksInOrder(std::int64_t blocks, BuiltStars& built) : waiting_(static_cast<std::size_t>(blocks)), built_(built) {
    constexpr std::size_t large_degree = 8;  // upper estimate of the mean over a cloud
    const std::size_t likely = large_degree * static_cast<std::size_t>(built.stars.size());
    built.stars.link.reserve(likely);
    built.stars.triangle.reserve(likely);
    built.support.radius.reserve(likely);
  }

  /// Takes the stars of block `number`.
  /// @param block emptied; mostly keeps its memory
  void take(std::size_t number, BlockOfStars& block) {
    const std::lock_guard lock(mutex_);
    if (number != next_) {
      waiting_[number].emplace(std::exchange(block, {}));
      return;
    }
    block.appendTo(built_);
    block.clear();
    for (++next_; next_ < waiting_.size() && waiting_[next_].has_value(); ++next_) {
      waiting_[next_]->appendTo(built_);
      waiting_[next_].reset();
    }
  }

 private:
  std::mutex mutex_;
  std::size_t next_ = 0;
  Buffer<std::optional<BlockOfStars>> waiting_;
  BuiltStars& built_;
};

}  // namespace tufted
