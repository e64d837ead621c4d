// Algorithm 1 of the paper: the sides of all triangles around each edge are ordered circularly, then glued front to
// back.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "base/buffer.h"
#include "base/point_buffer.h"
#include "cover/cover.h"
#include "cover/dihedral_order.h"
#include "cover/geometry.h"

namespace tufted {
namespace {

/// A side of a triangle, stored at the smaller of its two vertices.
struct UngluedSide {
  int other;  ///< the larger vertex
  int side;   ///< 3 t + s
};

/// A well-mixed function of (seed, value): the finaliser of SplitMix64.
std::uint64_t mix(std::uint64_t seed, std::uint64_t value) {
  std::uint64_t z = seed + (value + 1) * 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

/// Orders the triangles around an edge for gluing.
class EdgeCycle {
 public:
  EdgeCycle(const IntrinsicTriangulation& cover, const PointsView& points, const EdgeOrder& order)
      : cover_(cover), points_(points), order_(order) {}

  /// Sorts the sides of the edge (low, high) circularly. Ties keep their order, which is that of the triangles.
  void sort(int low, int high, std::span<UngluedSide> sides) {
    switch (order_.order) {
      case FaceOrder::angle:
        sortAroundEdge(
            points_, low, high, sides, [this](const UngluedSide& s) { return cornersOf(s)[(s.side + 2) % 3]; }, sort_);
        break;
      case FaceOrder::area:
        sort_.sort(sides, [this](const UngluedSide& s) { return areaOf(s); });
        break;
      case FaceOrder::random:
        sort_.sort(sides, [this](const UngluedSide& s) { return mix(order_.seed, s.side) >> 11; });
        break;
    }
  }

 private:
  const std::array<int, 3>& cornersOf(const UngluedSide& s) const { return cover_.faces[2 * (s.side / 3)]; }

  double areaOf(const UngluedSide& s) const {  // twice the area
    const auto& corner = cornersOf(s);
    const Eigen::Vector3d u = points_.row(corner[1]) - points_.row(corner[0]);
    const Eigen::Vector3d v = points_.row(corner[2]) - points_.row(corner[0]);
    return u.cross(v).norm();
  }

  const IntrinsicTriangulation& cover_;
  PointsView points_;
  const EdgeOrder& order_;
  KeySort<UngluedSide> sort_;
};

/// Glues front to back around the edge: of each triangle, the side that runs from the smaller to the larger vertex
/// ("plus") faces the next triangle of the circular order and is glued to the minus side of that one. A single triangle
/// is glued to itself.
void glueAround(IntrinsicTriangulation& cover, std::span<const UngluedSide> sides) {
  const auto plusAndMinus = [&](int side) {
    const int t = side / 3, s = side % 3;
    const int front = frontSide(t, s), back = backSide(t, s);
    return tail(cover, front) < head(cover, front) ? std::pair(front, back) : std::pair(back, front);
  };
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const std::size_t next = i + 1 == sides.size() ? 0 : i + 1;
    glueSides(cover, plusAndMinus(sides[i].side).first, plusAndMinus(sides[next].side).second);
  }
}

}  // namespace

EdgeCounts glueEdges(IntrinsicTriangulation& cover, const PointsView& points, const EdgeOrder& order,
                     const Workers& workers, std::vector<Boundary>* boundary) {
  // All sides that are not glued yet, grouped by their smaller vertex: count, prefix sum, fill.
  const int sides = static_cast<int>(3 * (cover.size() / 2));
  const auto isOpen = [&](int side) { return cover.glue[frontSide(side / 3, side % 3)] == unglued; };
  const auto ends = [&](int side) {
    const auto& corner = cover.faces[2 * (side / 3)];
    return std::minmax(corner[side % 3], corner[(side + 1) % 3]);
  };
  Buffer<int> offset(static_cast<std::size_t>(cover.vertices) + 1);
  for (int side = 0; side < sides; ++side) {
    if (isOpen(side)) ++offset[ends(side).first + 1];
  }
  std::partial_sum(offset.begin(), offset.end(), offset.begin());
  Buffer<UngluedSide> unglued_sides(offset.back());
  Buffer<int> fill(offset.begin(), offset.end() - 1);
  for (int side = 0; side < sides; ++side) {
    if (!isOpen(side)) continue;
    const auto [low, high] = ends(side);
    unglued_sides[fill[low]++] = {high, side};
  }
  release(fill);

  std::array<std::atomic<std::int64_t>, 3> edges = {};
  workers.forBlocks("glue", cover.vertices, usual_block, [&](std::int64_t begin, std::int64_t end, int) {
    EdgeCycle cycle(cover, points, order);
    std::array<std::int64_t, 3> count = {};
    for (int low = static_cast<int>(begin); low < end; ++low) {
      UngluedSide* at = unglued_sides.data() + offset[low];
      UngluedSide* const last = unglued_sides.data() + offset[low + 1];
      std::sort(at, last, [](const UngluedSide& a, const UngluedSide& b) {
        return a.other < b.other || (a.other == b.other && a.side < b.side);
      });
      while (at != last) {
        UngluedSide* const stop = std::find_if(at, last, [&](const UngluedSide& s) { return s.other != at->other; });
        const std::span around(at, stop);
        if (around.size() > 2) cycle.sort(low, at->other, around);  // all circular orders of two are the same
        glueAround(cover, around);
        ++count[std::min<std::size_t>(around.size(), 3) - 1];
        at = stop;
      }
    }
    for (int i = 0; i < 3; ++i) edges[i] += count[i];
  });

  if (boundary != nullptr) {
    for (int side = 0; side < sides; ++side) {
      if (cover.glue[frontSide(side / 3, side % 3)] != backSide(side / 3, side % 3)) continue;
      const auto [low, high] = ends(side);
      (*boundary)[low] = (*boundary)[high] = Boundary::rim;
    }
  }
  return {edges[0], edges[2]};
}

}  // namespace tufted
