#include "cloud/agreement.h"

#include <atomic>

#include "base/buffer.h"

namespace tufted {
namespace {

constexpr std::int64_t block_size = 8192;

/// The neighbours of link vertex i of star p in the link, if there is a triangle towards both.
struct Sides {
  int left = -1, right = -1;

  Sides(const Stars& stars, int p, int i) {
    const int previous = before(stars, p, i);
    if (stars.hasTriangle(previous)) left = stars.link[previous];
    if (stars.hasTriangle(i)) right = stars.link[stars.after(p, i)];
  }
  bool areWhole() const { return left >= 0 && right >= 0; }
  /// Either way round: the sign of normals is arbitrary.
  bool areThoseOf(const Sides& other) const {
    return (left == other.left && right == other.right) || (left == other.right && right == other.left);
  }
};

bool agreeOn(const Stars& stars, int p, int i) {
  const Sides here(stars, p, i);
  if (!here.areWhole()) return false;
  const int q = stars.link[i], j = entryOf(stars, q, p);
  return j >= 0 && here.areThoseOf(Sides(stars, q, j));
}

}  // namespace

Buffer<std::uint8_t> findDisagreement(const Stars& stars, const Workers& workers) {
  Buffer<std::uint8_t> disagrees(stars.size());
  workers.forBlocks("agreement", stars.size(), block_size, [&](std::int64_t begin, std::int64_t end, int) {
    for (int p = static_cast<int>(begin); p < end; ++p) {
      for (int i = stars.offset[p]; i < stars.offset[p + 1]; ++i) {
        if (agreeOn(stars, p, i)) continue;
        // Both, since the other one may not know of p at all. Several threads may write the same 1.
        std::atomic_ref(disagrees[p]).store(1, std::memory_order_relaxed);
        std::atomic_ref(disagrees[stars.link[i]]).store(1, std::memory_order_relaxed);
      }
    }
  });
  return disagrees;
}

}  // namespace tufted
