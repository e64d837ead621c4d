// Flips of thin faces (section 10 of docs/algorithm.md, step 2). Rounding a length of 1 to a double makes a height of
// 1e-8 in a face whose corners lie on a line, and each flip adds more. So meshes with thin faces are measured and
// flipped in long double first.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/buffer.h"
#include "cover/cover.h"
#include "cover/geometry.h"
#include "cover/short_edges.h"
#include "cover/whole_cover.h"

namespace tufted {
namespace {

/// A face whose slack is less than this share of its longest side is thin and is flipped in long double; with more
/// slack, rounding of lengths in double is at most 1e-8 of the area.
constexpr double thin_slack = 0x1p-26;
/// The length of an edge between coincident vertices while thin faces are flipped, as a share of the longest side: too
/// short to matter in an area, and far above rounding in long double.
constexpr double short_enough = 0x1p-40;
/// A slack below this share of the longest side may be only rounding, as corners on a line are on it in doubles only:
/// such a face is made exactly flat.
constexpr long double straight_slack = 32 * std::numeric_limits<long double>::epsilon();

/// A cover with lengths in long double that shares faces and glue with another.
struct PreciseCover {
  std::vector<std::array<int, 3>>& faces;
  std::vector<int>& glue;
  Buffer<long double> length;

  std::int64_t size() const { return std::ssize(faces); }
};

template <class Triangulation>
auto slackOf(const Triangulation& cover, std::int64_t f) {
  return triangleSlack(cover.length[3 * f], cover.length[3 * f + 1], cover.length[3 * f + 2]);
}

template <class Triangulation>
auto longestOf(const Triangulation& cover, std::int64_t f) {
  return std::max({cover.length[3 * f], cover.length[3 * f + 1], cover.length[3 * f + 2]});
}

/// Makes faces that are flat but for rounding exactly flat: their longest side becomes the sum of the others.
void straightenFlatFaces(PreciseCover& cover, const Workers& workers) {
  Buffer<int> flat = numbersWhere("lengths", static_cast<int>(cover.size()), workers,
                                  [&](int f) { return slackOf(cover, f) < straight_slack * longestOf(cover, f); });
  // By ascending length, because a long face may contain the edges of shorter ones.
  std::stable_sort(flat.begin(), flat.end(), [&](int f, int g) { return longestOf(cover, f) < longestOf(cover, g); });
  for (const int f : flat) {
    int side = 3 * f;
    for (const int other : {3 * f + 1, 3 * f + 2})
      if (cover.length[other] > cover.length[side]) side = other;
    const long double a = cover.length[nextSide(side)], b = cover.length[previousSide(side)];
    long double longest = std::max(cover.length[side], a + b);
    while (triangleSlack(longest, a, b) > 0) longest = std::nextafter(longest, HUGE_VALL);
    cover.length[side] = cover.length[cover.glue[side]] = longest;
  }
}

}  // namespace

FlipCounts flipThinFaces(IntrinsicTriangulation& cover, const EdgeLengths& lengths, double delta,
                         std::int64_t& lengthened, const Workers& workers) {
  const Buffer<int> thin = numbersWhere("lengths", static_cast<int>(cover.size()), workers,
                                        [&](int f) { return slackOf(cover, f) < thin_slack * longestOf(cover, f); });
  if (thin.empty()) return {};
  PreciseCover precise{cover.faces, cover.glue, Buffer<long double>(cover.length.size())};
  workers.forBlocks("lengths", precise.size(), cheap_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t side = 3 * begin; side < 3 * end; ++side) {
      const auto [x, y, z] = lengths.offset(tail(cover, static_cast<int>(side)), head(cover, static_cast<int>(side)));
      precise.length[side] = std::sqrt(static_cast<long double>(x) * x + static_cast<long double>(y) * y +
                                       static_cast<long double>(z) * z);
    }
  });
  straightenFlatFaces(precise, workers);
  // Angles beside an edge of length 0 are undefined. Its final length follows from its faces after the flips.
  if (delta > 0) lengthened += lengthenShortEdges(precise, short_enough, workers);
  WholeCover whole(precise, workers);
  const FlipCounts counts = flipEdges(whole, workers);
  std::copy(precise.length.begin(), precise.length.end(), cover.length.begin());
  return {counts.flips, 0};  // the flips in double that follow count the failures
}

}  // namespace tufted
