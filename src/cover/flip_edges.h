#pragma once

// Algorithm 2 of the paper, for whole covers and for parts of covers.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

#include "base/buffer.h"
#include "cover/cotan_rounding.h"
#include "cover/cover.h"
#include "cover/geometry.h"

namespace tufted {

/// An edge is flipped if cot + cot is below this: four points on a circle stay as they are, and rounding of well-shaped
/// faces is far smaller.
constexpr double flip_below = -1e-10;

/// Equation 2, with a tolerance, because rounding could flip an edge back and forth for ever. An edge with both sides
/// in one triangle is Delaunay: its two opposite angles sum to less than pi. So is one without an obtuse opposite
/// angle, a test without roots.
template <class Triangulation>
bool isDelaunay(const Triangulation& t, int side, int mate) {
  return side / 3 == mate / 3 || !(isOppositeObtuse(t, side) || isOppositeObtuse(t, mate)) ||
         !isBelowRounding(oppositeCotan(t, side), oppositeCotan(t, mate), -flip_below);
}

/// Length of the other diagonal of the two faces of an edge, from a layout of both in the plane with the common edge on
/// the x axis (Fisher et al. 2007): accurate where the law of cosines cancels digits.
template <class Triangulation>
auto flippedLength(const Triangulation& t, int side, int mate) {
  const auto base = t.length[side];
  using Real = std::remove_const_t<decltype(base)>;
  // Apex of a triangle over the base from (0, 0), given the distances to its start and end.
  const auto apex = [&](Real from_start, Real from_end) {
    const Real x = ((from_start - from_end) * (from_start + from_end) / base + base) / 2;
    const Real y = 2 * triangleArea<Real>(base, from_start, from_end) / base;
    return std::array<Real, 2>{x, y};
  };
  const auto above = apex(t.length[previousSide(side)], t.length[nextSide(side)]);
  const auto below = apex(t.length[nextSide(mate)], t.length[previousSide(mate)]);
  return std::hypot(above[0] - below[0], above[1] + below[1]);
}

/// `length`, or up to 1024 last bits less, so that a flipped edge of this length is Delaunay in doubles too. `outer`
/// are the other sides of its two triangles, the first two and the last two.
///
/// In exact arithmetic an edge that was flipped is Delaunay. But near pi rounding the side opposite in its last bit
/// changes the cotangent by about epsilon cot^3. The shorter the edge, the larger the sum.
template <class Real>
Real delaunayLength(Real length, const std::array<Real, 4>& outer) {
  // A flipped edge is shortened by at most this many last bits, 2^-42 of its length.
  constexpr int most_ulps = 1024;
  const auto isFine = [&outer](Real l) {
    return !(cotanNumerator(l, outer[0], outer[1]) < 0 || cotanNumerator(l, outer[2], outer[3]) < 0) ||
           !(oppositeCotan(l, outer[0], outer[1]) + oppositeCotan(l, outer[2], outer[3]) < flip_below);
  };
  Real rounded = length;
  for (int ulps = 1; !isFine(rounded); ulps *= 2) {
    if (ulps > most_ulps) return length;
    rounded = length * (1 - ulps * std::numeric_limits<Real>::epsilon());
  }
  return rounded;
}

/// Flips the edge i j between the faces (i, j, k) and (j, i, m) to k m (Figure 12). The flipped edge keeps its two side
/// numbers; the faces become (m, k, i) and (k, m, j), counted from these sides.
template <class Triangulation>
void flip(Triangulation& t, int side, int mate) {
  const int jk = nextSide(side), ki = previousSide(side);
  const int im = nextSide(mate), mj = previousSide(mate);
  const int i = tail(t, side), j = head(t, side), k = head(t, jk), m = head(t, im);
  using Real = std::decay_t<decltype(t.length[0])>;
  const Real flipped =
      delaunayLength<Real>(flippedLength(t, side, mate), {t.length[ki], t.length[im], t.length[mj], t.length[jk]});

  // New places of the four outer sides: k i after `side`, then i m; m j after `mate`, then j k.
  const std::array<int, 4> from = {ki, im, mj, jk};
  const std::array<int, 4> to = {jk, ki, im, mj};
  std::array<int, 4> outer_mate;
  std::array<Real, 4> outer_length;
  for (int e = 0; e < 4; ++e) {
    outer_mate[e] = t.glue[from[e]];
    outer_length[e] = t.length[from[e]];
    for (int o = 0; o < 4; ++o) {  // outer sides may be glued to each other
      if (t.glue[from[e]] == from[o]) outer_mate[e] = to[o];
    }
  }
  for (int e = 0; e < 4; ++e) {
    t.length[to[e]] = outer_length[e];
    glueSides(t, to[e], outer_mate[e]);
  }
  const auto setCorners = [&](int first, int a, int b, int c) {
    auto& face = t.faces[first / 3];
    face[first % 3] = a;
    face[nextSide(first) % 3] = b;
    face[previousSide(first) % 3] = c;
  };
  setCorners(side, m, k, i);
  setCorners(mate, k, m, j);
  t.length[side] = t.length[mate] = flipped;
}

/// The sides with numbers in [begin, end).
struct SideRange {
  int begin = 0, end = std::numeric_limits<int>::max();

  bool isWhole() const { return end == std::numeric_limits<int>::max(); }
  bool contains(int side) const { return begin <= side && side < end; }
};

/// Algorithm 2 within a range of sides: a face that is glued to one outside of the range is not flipped. For `Cover`
/// see flipEdges().
template <class Cover>
class RangeFlipper {
 public:
  /// @param queues scratch
  /// @param left sides that must be tested in a wider range are appended here
  RangeFlipper(Cover& cover, SideRange range, std::array<Buffer<int>, 2>& queues, Buffer<int>& left)
      : cover_(cover), range_(range), round_(queues[0]), next_round_(queues[1]), left_(left) {
    round_.clear();
    next_round_.clear();
  }

  /// Queues the edge of a side, or appends it to `left` if it leaves the range.
  void push(int side) {
    if (!isInside(side)) return left_.push_back(side);
    const int edge = std::min(side, cover_.triangulation().glue[side]);
    std::uint8_t& state = cover_.state(edge);
    if (state != 0) return;
    state = 1;  // queued
    next_round_.push_back(edge);
  }

  /// Flips queued edges, first in, first out: last in, first out takes thousands of flips of one edge on a long thin
  /// bar.
  /// @param report called now and then with the share of the edges that is done
  template <class Report>
  FlipCounts run(const Report& report) {
    FlipCounts counts;
    for (int rounds = 0; !next_round_.empty(); ++rounds) {
      std::swap(round_, next_round_);
      next_round_.clear();
      for (const int side : round_) {
        cover_.state(side) = 0;
        if (rounds < most_rounds)
          flipUnlessDelaunay(side, counts, report);
        else
          counts.failures += isDelaunay(cover_.triangulation(), side, cover_.triangulation().glue[side]) ? 0 : 1;
      }
    }
    return counts;
  }

 private:
  // In exact arithmetic flips end; this ends what rounding might make go in circles. An edge is flipped at most once in
  // a round, and 300 times in all on the longest fans that were tried.
  static constexpr int most_rounds = 1 << 16;
  static constexpr std::int64_t report_every = 1 << 16;  // flips

  template <class Report>
  void flipUnlessDelaunay(int side, FlipCounts& counts, const Report& report) {
    auto& t = cover_.triangulation();
    const int mate = t.glue[side];
    if (isDelaunay(t, side, mate)) return;
    const std::array<int, 4> outer = {nextSide(side), previousSide(side), nextSide(mate), previousSide(mate)};
    if (!std::all_of(outer.begin(), outer.end(), [this](int o) { return isInside(o); })) {
      left_.push_back(side);
      return;
    }
    flip(t, side, mate);
    cover_.flipped(side, mate);
    if (++counts.flips % report_every == 0)
      report(1 - static_cast<double>(round_.size()) / static_cast<double>(t.glue.size()));
    for (const int o : outer) push(o);
  }

  /// Whether the side's mate, too, is in the range; only such edges may be flipped.
  bool isInside(int side) const {
    return cover_.resolve(side, range_) && range_.contains(cover_.triangulation().glue[side]);
  }

  Cover& cover_;
  const SideRange range_;
  Buffer<int>&round_, &next_round_;
  Buffer<int>& left_;
};

/// Algorithm 2 (section 11 of docs/algorithm.md). Blocks of the cover are flipped separately, in parallel; edges across
/// their borders wait for the next round, whose blocks are larger. Blocks do not depend on the number of threads.
/// `Cover` has
template <class Cover>
FlipCounts flipEdges(Cover& cover, const Workers& workers) {
  // Number of blocks that are joined to one for the next round.
  constexpr std::int64_t growth = 8;
  Buffer<std::array<Buffer<int>, 2>> queues(workers.count());
  Buffer<Buffer<int>> left;
  FlipCounts sum;
  for (std::int64_t merged = 1;; merged *= growth) {  // blocks that are joined
    const std::int64_t count = (cover.blocks() + merged - 1) / merged;
    const Buffer<Buffer<int>> waiting = std::exchange(left, Buffer<Buffer<int>>(count));
    Buffer<FlipCounts> counts(count);
    const auto flipBlock = [&](std::int64_t b, SideRange range, int worker, const auto& report) {
      RangeFlipper<Cover> flipper(cover, range, queues[worker], left[b]);
      const auto push = [&flipper](int side) { flipper.push(side); };
      if (merged == 1) cover.start(b, push);
      for (std::int64_t i = growth * b; i < std::min(growth * (b + 1), std::ssize(waiting)); ++i)
        std::for_each(waiting[i].begin(), waiting[i].end(), push);
      counts[b] = flipper.run(report);
    };
    if (count == 1) {
      flipBlock(0, {}, 0, [&workers](double share) { workers.report("flips", share); });
    } else {
      workers.forBlocks("flips", count, 1, [&](std::int64_t b, std::int64_t, int worker) {
        flipBlock(b, cover.sidesOf(b * merged, std::min((b + 1) * merged, cover.blocks())), worker, [](double) {});
      });
    }
    for (const FlipCounts& part : counts) sum += part;
    if (std::all_of(left.begin(), left.end(), [](const auto& part) { return part.empty(); })) return sum;
  }
}

}  // namespace tufted
