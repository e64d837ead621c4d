#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace tufted {

/// Disjoint sets in which each element has the sign of its set's root or the opposite one.
class SignedSets {
 public:
  explicit SignedSets(int size) : parent_(size), turned_(size, 0) {
    for (int i = 0; i < size; ++i) parent_[i] = i;
  }

  int size() const { return static_cast<int>(parent_.size()); }

  /// Whether the sign of an element is opposite to its root's.
  bool isTurned(int element) {
    compress(element);
    return turned_[element] != 0;
  }

  /// Joins the different sets of a and b so that b has the sign of a, or the opposite one if `turns`.
  void unite(int a, int b, bool turns) {
    const int first = compress(a), second = compress(b);
    const bool differ = (turned_[a] ^ turned_[b]) != (turns ? 1 : 0);
    parent_[std::max(first, second)] = std::min(first, second);
    turned_[std::max(first, second)] = differ ? 1 : 0;
  }

 private:
  /// Makes the root of an element its parent, and returns it.
  int compress(int element) {
    int root = element;
    bool turned = false;
    for (; parent_[root] != root; root = parent_[root]) turned ^= turned_[root] != 0;
    while (parent_[element] != root) {
      const int next = parent_[element];
      const bool is_turned = turned_[element] != 0;
      parent_[element] = root;
      turned_[element] = turned ? 1 : 0;
      turned ^= is_turned;
      element = next;
    }
    return root;
  }

  std::vector<int> parent_;
  std::vector<std::uint8_t> turned_;
};

}  // namespace tufted
