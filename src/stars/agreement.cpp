#include "stars/agreement.h"

#include <atomic>

#include "base/buffer.h"

namespace tufted {
namespace {

constexpr std::int64_t block_size = 8192;

/// Whether the stars of p and of link vertex i have the same two triangles at their edge.
bool agreeOn(const Stars& stars, int p, int i) {
  const Sides here(stars, p, i);
  if (!here.areWhole()) return false;
  const int q = stars.link[i], j = entryOf(stars, q, p);
  return j >= 0 && here.areThoseOf(Sides(stars, q, j));
}

/// Compares the stars of one block with those of their link vertices; two of the block once.
class BlockComparison {
 public:
  BlockComparison(const Stars& stars, int begin, int end, Buffer<std::uint8_t>& disagrees)
      : stars_(stars), begin_(begin), end_(end), disagrees_(disagrees), agreed_(end - begin) {}

  void run() {
    for (int p = begin_; p < end_; ++p) {
      int before = 0;  // link vertices that were compared with p if it is in their link
      for (int i = stars_.offset[p]; i < stars_.offset[p + 1]; ++i) {
        if (isEarlier(stars_.link[i], p))
          ++before;
        else
          compare(p, i);
      }
      if (before == agreed_[p - begin_]) continue;
      for (int i = stars_.offset[p]; i < stars_.offset[p + 1]; ++i)
        if (isEarlier(stars_.link[i], p)) compare(p, i);
    }
  }

 private:
  bool isEarlier(int q, int p) const { return q >= begin_ && q < p; }

  void compare(int p, int i) {
    const int q = stars_.link[i];
    if (agreeOn(stars_, p, i)) {
      if (q > p && q < end_) ++agreed_[q - begin_];
      return;
    }
    // Both, since the other one may not know of p at all. Several threads may write the same 1.
    std::atomic_ref(disagrees_[p]).store(1, std::memory_order_relaxed);
    std::atomic_ref(disagrees_[q]).store(1, std::memory_order_relaxed);
  }

  const Stars& stars_;
  const int begin_, end_;
  Buffer<std::uint8_t>& disagrees_;
  Buffer<int> agreed_;  ///< with each: link vertices of the block before it
};

}  // namespace

Buffer<std::uint8_t> findDisagreement(const Stars& stars, const Workers& workers) {
  Buffer<std::uint8_t> disagrees(stars.size());
  workers.forBlocks("agreement", stars.size(), block_size, [&](std::int64_t begin, std::int64_t end, int) {
    BlockComparison(stars, static_cast<int>(begin), static_cast<int>(end), disagrees).run();
  });
  return disagrees;
}

}  // namespace tufted
