#include "stars/agreement.h"

#include <atomic>

#include "base/buffer.h"

namespace tufted {
namespace {

/// Whether the stars of p and of link vertex i have the same two triangles at the edge between both.
bool agreeOn(const Stars& stars, int p, int i) {
  const Sides here(stars, p, i);
  if (!here.areWhole()) return false;
  const int q = stars.link[i], j = entryOf(stars, q, p);
  return j >= 0 && here.areThoseOf(Sides(stars, q, j));
}

}  // namespace

Buffer<std::uint8_t> findDisagreement(const Stars& stars, const Workers& workers, const Buffer<std::uint8_t>& among) {
  Buffer<std::uint8_t> disagrees(stars.size());
  workers.forBlocks("agreement", stars.size(), cheap_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (int p = static_cast<int>(begin); p < end; ++p) {
      if (!among.empty() && among[p] == 0) continue;
      for (int i = stars.offset[p]; i < stars.offset[p + 1]; ++i) {
        if (agreeOn(stars, p, i)) continue;
        // The star of link vertex i need not contain p. Several threads may write the same 1.
        for (const int q : {p, stars.link[i]}) std::atomic_ref(disagrees[q]).store(1, std::memory_order_relaxed);
      }
    }
  });
  return disagrees;
}

}  // namespace tufted
