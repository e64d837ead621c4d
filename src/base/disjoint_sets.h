#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>

#include "base/buffer.h"

namespace tufted {

/// Union-find with path halving. The root of a set is its smallest element, so the result does not depend on the order
/// of the unions.
class DisjointSets {
 public:
  /// The sets {0}, {1}, ..., {size - 1}.
  explicit DisjointSets(std::int64_t size) : parent_(static_cast<std::size_t>(size)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  int root(int element) {
    while (parent_[element] != element) element = parent_[element] = parent_[parent_[element]];
    return element;
  }

  /// Joins two sets; returns whether they were different.
  bool unite(int a, int b) {
    a = root(a), b = root(b);
    if (a == b) return false;
    parent_[std::max(a, b)] = std::min(a, b);
    return true;
  }

 private:
  Buffer<int> parent_;
};

}  // namespace tufted
