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

  /// The root of an element's set, which becomes its parent.
  int root(int element) {
    int top = element;
    bool turned = false;
    for (; parent_[top] != top; top = parent_[top]) turned ^= turned_[top] != 0;
    while (parent_[element] != top) {
      const int next = parent_[element];
      const bool is_turned = turned_[element] != 0;
      parent_[element] = top;
      turned_[element] = turned ? 1 : 0;
      turned ^= is_turned;
      element = next;
    }
    return top;
  }

  /// Whether the sign of an element is opposite to its root's.
  bool isTurned(int element) {
    root(element);
    return turned_[element] != 0;
  }

  /// Joins the different sets of a and b so that b has the sign of a, or the opposite one if `turns`.
  void unite(int a, int b, bool turns) {
    const int first = root(a), second = root(b);
    const bool differ = (turned_[a] ^ turned_[b]) != (turns ? 1 : 0);
    parent_[std::max(first, second)] = std::min(first, second);
    turned_[std::max(first, second)] = differ ? 1 : 0;
  }

 private:
  std::vector<int> parent_;
  std::vector<std::uint8_t> turned_;
};

}  // namespace tufted
