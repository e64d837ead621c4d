#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace tufted {

/// A heap of numbers ordered by key, the least first. Keys may be lowered.
class MarchHeap {
 public:
  struct Entry {
    double key;
    int number;
  };

  /// @param size numbers lie in [0, size)
  explicit MarchHeap(std::size_t size) : place_(size, absent) {}

  bool empty() const { return entries_.empty(); }
  const Entry& top() const { return entries_.front(); }

  /// Adds a number, or lowers its key.
  void lower(int number, double key) {
    int place = place_[number];
    if (place == absent) {
      place = static_cast<int>(entries_.size());
      entries_.push_back({key, number});
    }
    while (place > 0) {
      const int parent = (place - 1) / children;
      if (!(key < entries_[parent].key)) break;
      put(entries_[parent], place);
      place = parent;
    }
    put({key, number}, place);
  }

  void pop() {
    place_[top().number] = absent;
    const Entry last = entries_.back();
    entries_.pop_back();
    if (entries_.empty()) return;
    const int size = static_cast<int>(entries_.size());
    int place = 0;
    while (true) {
      const int first = children * place + 1;
      if (first >= size) break;
      int least = first;
      for (int child = first + 1; child < std::min(first + children, size); ++child)
        if (entries_[child].key < entries_[least].key) least = child;
      if (!(entries_[least].key < last.key)) break;
      put(entries_[least], place);
      place = least;
    }
    put(last, place);
  }

 private:
  /// Place of a number outside of the heap; children per entry: with four it is half as deep as with two.
  static constexpr int absent = -1, children = 4;

  void put(const Entry& entry, int place) {
    entries_[place] = entry;
    place_[entry.number] = place;
  }

  std::vector<Entry> entries_;
  std::vector<int> place_;  ///< place of each number in `entries_`
};

}  // namespace tufted
