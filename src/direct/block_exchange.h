#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>

#include "base/buffer.h"

namespace tufted {

/// Passes items between blocks of points: each block sends in its own thread, and when all have sent, each receives.
/// Items arrive in the order of the sending blocks, so results do not depend on the threads.
template <class Item>
class BlockExchange {
 public:
  explicit BlockExchange(std::size_t blocks) : parcels_(blocks), begin_(blocks + 1) {}

  /// @param items from block `from`, in any order
  /// @param receiver receiver(item) is the number of the block that the item is for
  /// @param scratch overwritten
  template <class Receiver>
  void send(std::size_t from, const Buffer<Item>& items, const Receiver& receiver, Buffer<int>& scratch) {
    if (items.empty()) return;
    Buffer<int>& fill = scratch;  // by receiver
    fill.assign(parcels_.size() + 1, 0);
    for (const Item& item : items) ++fill[receiver(item) + 1];
    Parcel& parcel = parcels_[from];
    std::partial_sum(fill.begin(), fill.end(), fill.begin());
    for (std::size_t to = 0; to < parcels_.size(); ++to)
      if (fill[to] < fill[to + 1]) parcel.shares.push_back({to, fill[to], fill[to + 1]});
    parcel.items.resize(items.size());
    for (const Item& item : items) parcel.items[fill[receiver(item)]++] = item;
  }

  /// Called by one thread after all blocks have sent.
  void deliver() {
    for (const Parcel& parcel : parcels_)
      for (const Share& share : parcel.shares) ++begin_[share.block + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    shares_.resize(static_cast<std::size_t>(begin_.back()));
    Buffer<int> fill(begin_.begin(), begin_.end() - 1);
    for (std::size_t from = 0; from < parcels_.size(); ++from)
      for (const Share& share : parcels_[from].shares) shares_[fill[share.block]++] = {from, share.begin, share.end};
  }

  /// Calls visit(item) for all items sent to a block.
  template <class Visit>
  void receive(std::size_t to, const Visit& visit) const {
    for (int i = begin_[to]; i < begin_[to + 1]; ++i)
      for (int j = shares_[i].begin; j < shares_[i].end; ++j) visit(parcels_[shares_[i].block].items[j]);
  }

 private:
  /// Range of the items for, or from, one block.
  struct Share {
    std::size_t block;
    int begin, end;
  };
  struct Parcel {
    RawBuffer<Item> items;  ///< by receiver
    Buffer<Share> shares;
  };

  Buffer<Parcel> parcels_;  ///< by sender
  Buffer<int> begin_;       ///< start of each receiver in `shares_`
  Buffer<Share> shares_;    ///< by receiver, then by sender
};

}  // namespace tufted
