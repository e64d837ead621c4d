#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tufted {

/// A number for each of some pairs of indices, in a hash table of a fixed size with linear probing.
class PairSums {
 public:
  /// @param most number of pairs at any time
  explicit PairSums(std::size_t most) : slots_(most + most / 2 + 1) {}

  /// The number of a pair, in either order; null if it has none. Valid until the next change.
  const double* find(int a, int b) const {
    const std::size_t slot = slotOf(keyOf(a, b));
    return slots_[slot].key == none ? nullptr : &slots_[slot].value;
  }
  /// The number of a pair, at first 0.
  double& at(int a, int b) {
    Slot& slot = slots_[slotOf(keyOf(a, b))];
    if (slot.key == none) slot = {keyOf(a, b), 0};
    return slot.value;
  }
  /// Removes a pair. Later ones move up, so that no search ends before it finds them.
  void erase(int a, int b) {
    std::size_t hole = slotOf(keyOf(a, b));
    for (std::size_t slot = after(hole); slots_[slot].key != none; slot = after(slot)) {
      if (wayTo(slot, home(slots_[slot].key)) < wayTo(slot, hole)) continue;
      slots_[hole] = slots_[slot];
      hole = slot;
    }
    slots_[hole].key = none;
  }

 private:
  static constexpr std::uint64_t none = ~std::uint64_t{0};
  struct Slot {
    std::uint64_t key = none;
    double value = 0;
  };

  static std::uint64_t keyOf(int a, int b) {
    return static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint32_t>(std::max(a, b));
  }
  std::size_t after(std::size_t slot) const { return slot + 1 < slots_.size() ? slot + 1 : 0; }
  /// How many slots come from `from` to `slot`, cyclically.
  std::size_t wayTo(std::size_t slot, std::size_t from) const {
    return slot >= from ? slot - from : slot + slots_.size() - from;
  }
  /// Mixes the bits of a key (the finalizer of MurmurHash3).
  std::size_t home(std::uint64_t key) const {
    key = (key ^ key >> 33) * 0xff51afd7ed558ccdULL;
    key = (key ^ key >> 33) * 0xc4ceb9fe1a85ec53ULL;
    return (key ^ key >> 33) % slots_.size();
  }
  std::size_t slotOf(std::uint64_t key) const {
    std::size_t slot = home(key);
    while (slots_[slot].key != none && slots_[slot].key != key) slot = after(slot);
    return slot;
  }

  std::vector<Slot> slots_;
};

}  // namespace tufted
