#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "base/buffer.h"
#include "intrinsic/cover.h"
#include "intrinsic/geometry.h"

namespace tufted {

constexpr double flip_below = -1e-10;  // on cot + cot; ties of cocircular quadrilaterals stay

/// Equation 2. An edge with both sides in one triangle is Delaunay: its two opposite angles sum to less than pi. So is
/// one without an obtuse angle, which takes no roots to see.
template <class Triangulation>
bool isDelaunay(const Triangulation& t, int side, int mate) {
  return side / 3 == mate / 3 || !(isOppositeObtuse(t, side) || isOppositeObtuse(t, mate)) ||
         !(oppositeCotan(t, side) + oppositeCotan(t, mate) < flip_below);
}

/// Length of the other diagonal, from a layout of both triangles in the plane with the common edge on the x axis
/// (Fisher et al. 2007): it stays accurate where the law of cosines cancels.
template <class Triangulation>
double flippedLength(const Triangulation& t, int side, int mate) {
  const double base = t.length[side];
  // Apex of a triangle over the base from (0, 0), given the distances to its start and end.
  const auto apex = [&](double from_start, double from_end) {
    const double x = ((from_start - from_end) * (from_start + from_end) / base + base) / 2;
    const double y = 2 * triangleArea(base, from_start, from_end) / base;
    return std::array<double, 2>{x, y};
  };
  const auto above = apex(t.length[previousSide(side)], t.length[nextSide(side)]);
  const auto below = apex(t.length[nextSide(mate)], t.length[previousSide(mate)]);
  return std::hypot(above[0] - below[0], above[1] + below[1]);
}

/// Flips the edge i j between the faces (i, j, k) and (j, i, m) to k m (Figure 12). The flipped edge keeps its two side
/// numbers; the faces become (m, k, i) and (k, m, j), counted from these sides.
template <class Triangulation>
void flip(Triangulation& t, int side, int mate) {
  const int jk = nextSide(side), ki = previousSide(side);
  const int im = nextSide(mate), mj = previousSide(mate);
  const int i = tail(t, side), j = head(t, side), k = head(t, jk), m = head(t, im);
  const double flipped = flippedLength(t, side, mate);

  // New places of the four outer sides: k i after `side`, then i m; m j after `mate`, then j k.
  const std::array<int, 4> from = {ki, im, mj, jk};
  const std::array<int, 4> to = {jk, ki, im, mj};
  std::array<int, 4> outer_mate;
  std::array<double, 4> outer_length;
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

/// Algorithm 2 from the given sides on. `Cover` has
///   triangulation()                    a reference to an IntrinsicTriangulation or CoverBuffer
///   void resolve(int side)             sees to it that the side is glued; may add faces
///   void flipped(int side, int mate)   hears of each flip
template <class Cover>
FlipCounts flipEdges(Cover& cover, const Buffer<int>& seeds, const Workers& workers) {
  constexpr std::uint8_t most_flips = 100;    // per edge
  constexpr std::uint8_t queued_flag = 0x80;  // beside the count
  constexpr std::int64_t report_every = 1 << 16;
  auto& t = cover.triangulation();
  FlipCounts counts;

  // Per place of a side: the flips done there and queued_flag. A flip moves its outer edges to other places and queues
  // them anew, so no edge is missed, and the bound per place ends the loop whatever the lengths are.
  Buffer<std::uint8_t> state;
  Buffer<int> queue;  // depth first
  const auto push = [&](int side) {
    cover.resolve(side);
    state.resize(t.glue.size());
    const int edge = std::min(side, t.glue[side]);
    if ((state[edge] & queued_flag) != 0) return;
    state[edge] |= queued_flag;
    queue.push_back(edge);
  };
  for (const int side : seeds) push(side);

  while (!queue.empty()) {
    const int side = queue.back(), mate = t.glue[side];
    queue.pop_back();
    state[side] &= static_cast<std::uint8_t>(~queued_flag);
    if (isDelaunay(t, side, mate)) continue;
    if (state[side] >= most_flips) {
      ++counts.failures;
      continue;
    }
    const std::array<int, 4> outer = {nextSide(side), previousSide(side), nextSide(mate), previousSide(mate)};
    for (const int o : outer) cover.resolve(o);  // only sides that are glued may move
    flip(t, side, mate);
    cover.flipped(side, mate);
    ++state[side];
    if (++counts.flips % report_every == 0)
      workers.report("flips", 1 - static_cast<double>(queue.size()) / static_cast<double>(t.glue.size()));
    for (const int o : outer) push(o);
  }
  return counts;
}

}  // namespace tufted
