#include "cloud/star_filter.h"

#include <algorithm>
#include <array>
#include <atomic>

namespace tufted {
namespace {

constexpr std::int64_t block_size = 8192;

/// Whether the star of `a` contains the triangle (a, b, c), either way round.
bool contains(const Stars& stars, int a, int b, int c) {
  for (int i = stars.offset[a]; i < stars.offset[a + 1]; ++i) {
    const int x = stars.link[i], y = stars.link[stars.after(a, i)];
    if (stars.hasTriangle(i) && ((x == b && y == c) || (x == c && y == b))) return true;
  }
  return false;
}

}  // namespace

void filterStars(Stars& stars, int k, const Workers& workers, Report& report) {
  const bool whole_cloud = stars.size() <= k + 1;
  std::atomic<std::int64_t> dropped{0};
  workers.forBlocks("filter", stars.size(), block_size, [&](std::int64_t begin, std::int64_t end, int) {
    std::int64_t count = 0;
    for (int p = static_cast<int>(begin); p < end; ++p) {
      for (int i = stars.offset[p]; i < stars.offset[p + 1]; ++i) {
        if (!stars.hasTriangle(i) || whole_cloud) continue;
        const int a = stars.link[i], b = stars.link[stars.after(p, i)];
        const double smallest = std::min({stars.reach[p], stars.reach[a], stars.reach[b]});
        if (stars.radius[i] <= stars.reach[p] && stars.radius[i] <= 4 * smallest) continue;
        stars.radius[i] = no_triangle;
        stars.ends[p] = 1;
        ++count;
      }
    }
    dropped += count;
  });
  report.dropped_triangles += dropped;
}

void countVotes(const Stars& stars, const Workers& workers, Report& report) {
  std::array<std::atomic<std::int64_t>, 3> copies = {};
  workers.forBlocks("votes", stars.size(), block_size, [&](std::int64_t begin, std::int64_t end, int) {
    std::array<std::int64_t, 3> found = {};
    for (int p = static_cast<int>(begin); p < end; ++p) {
      for (int i = stars.offset[p]; i < stars.offset[p + 1]; ++i) {
        if (!stars.hasTriangle(i)) continue;
        const int a = stars.link[i], b = stars.link[stars.after(p, i)];
        ++found[(contains(stars, a, b, p) ? 1 : 0) + (contains(stars, b, p, a) ? 1 : 0)];
      }
    }
    for (int v = 0; v < 3; ++v) copies[v] += found[v];
  });
  for (int v = 0; v < 3; ++v) report.votes[v] = copies[v] / (v + 1);  // v + 1 stars each count it once
}

}  // namespace tufted
