// Algorithm 1 of the paper on stars; cover/glue.cpp is the reference.
#include "direct/radial_cycles.h"

#include <algorithm>
#include <numeric>
#include <span>

#include "base/buffer.h"
#include "base/point_buffer.h"
#include "base/stable_sort.h"
#include "cover/dihedral_order.h"
#include "stars/agreement.h"

namespace tufted {
namespace {

/// Calls visit(side) for the sides of the star of p that are not glued within it.
template <class Visit>
void forEachOpenSide(const Stars& stars, int p, const Visit& visit) {
  for (int i = stars.offset[p]; i < stars.offset[p + 1]; ++i) {
    if (!stars.hasTriangle(i)) continue;
    if (!stars.hasTriangle(before(stars, p, i))) visit(StarSide{p, i, 0});
    visit(StarSide{p, i, 1});
    if (!stars.hasTriangle(stars.after(p, i))) visit(StarSide{p, i, 2});
  }
}

}  // namespace

RadialCycles::RadialCycles(const Stars& stars, const Buffer<std::uint8_t>& disagreement, const PointsView& points,
                           const Workers& workers)
    : stars_(stars), disagrees_(disagreement) {
  collect(workers);
  sort(points, workers);
}

void RadialCycles::collect(const Workers& workers) {
  const int n = stars_.size();
  const Buffer<int> near = numbersWhere("glue", n, workers, [this](int p) {  // other stars have no side in a cycle
    const auto first = stars_.link.begin() + stars_.offset[p], last = stars_.link.begin() + stars_.offset[p + 1];
    return std::any_of(first, last, [this](int q) { return disagrees(q); });
  });
  const auto forEachUnglued = [&](const auto& visit) {
    for (const int p : near) {
      forEachOpenSide(stars_, p, [&](const StarSide& side) {
        if (isInCycle(side)) visit(side, std::minmax({tail(stars_, side), head(stars_, side)}));
      });
    }
  };
  offset_.assign(static_cast<std::size_t>(n) + 1, 0);
  forEachUnglued([&](const StarSide&, const auto& ends) { ++offset_[ends.first + 1]; });
  std::partial_sum(offset_.begin(), offset_.end(), offset_.begin());
  sides_.resize(static_cast<std::size_t>(offset_.back()));
  Buffer<int> fill(offset_.begin(), offset_.end() - 1);
  forEachUnglued([&](const StarSide& side, const auto& ends) { sides_[fill[ends.first]++] = {ends.second, side}; });
}

void RadialCycles::sort(const PointsView& points, const Workers& workers) {
  workers.forBlocks("glue", stars_.size(), cheap_block, [&](std::int64_t begin, std::int64_t end, int) {
    Buffer<CycleSide> sides;
    KeySort<CycleSide> key_sort;
    for (int low = static_cast<int>(begin); low < end; ++low) {
      // Stable: ties keep the order of stars and entries.
      stableSort(sides_.data() + offset_[low], sides_.data() + offset_[low + 1], sides,
                 [](const CycleSide& a, const CycleSide& b) { return a.high < b.high; });
      for (int i = offset_[low], stop = 0; i < offset_[low + 1]; i = stop) {
        stop = endOfCycle(i);
        sortAroundEdge(
            points, low, sides_[i].high, std::span(sides_.data() + i, sides_.data() + stop),
            [this](const CycleSide& s) { return apex(stars_, s.side); }, key_sort);
      }
    }
  });
}

int RadialCycles::endOfCycle(int i) const {
  int stop = i + 1;
  const StarSide side = sides_[i].side;
  const int last = offset_[std::min(tail(stars_, side), head(stars_, side)) + 1];
  while (stop < last && sides_[stop].high == sides_[i].high) ++stop;
  return stop;
}

StarSide RadialCycles::neighbor(const StarSide& side, int step) const {
  const int from = tail(stars_, side), to = head(stars_, side);
  if (!disagrees(from)) return acrossAgreeing(side, from, to);
  if (!disagrees(to)) return acrossAgreeing(side, to, from);
  const int low = std::min(from, to);
  int at = offset_[low];
  while (sides_[at].side != side) ++at;
  int begin = at, end = at + 1;
  while (begin > offset_[low] && sides_[begin - 1].high == sides_[at].high) --begin;
  while (end < offset_[low + 1] && sides_[end].high == sides_[at].high) ++end;
  const int count = end - begin;
  return sides_[begin + (at - begin + step + count) % count].side;
}

StarSide RadialCycles::acrossAgreeing(const StarSide& side, int agreeing, int other) const {
  const int j = entryOf(stars_, agreeing, other);
  const int left = stars_.link[before(stars_, agreeing, j)];
  const int star = left == side.star ? stars_.link[stars_.after(agreeing, j)] : left;
  const int i = entryOf(stars_, star, agreeing);
  return {star, stars_.link[stars_.after(star, i)] == other ? i : before(stars_, star, i), 1};
}

}  // namespace tufted
