#include <algorithm>
#include <cmath>
#include <limits>

#include "intrinsic/geometry.h"
#include "tufted/intrinsic_triangulation.h"

namespace tufted {
namespace {

/// How far the cotangent opposite a side may be off because lengths are rounded: epsilon of the longest side, seen from
/// the shortest, over sin^3. Infinite in a face of no area.
double needleRounding(const IntrinsicTriangulation& cover, int side, double cotan) {
  const double a = cover.length[side], b = cover.length[nextSide(side)], c = cover.length[previousSide(side)];
  const double aspect = std::max({a, b, c}) / std::min({a, b, c});
  return 16 * std::numeric_limits<double>::epsilon() * aspect * std::abs(cotan) * cotan * cotan;
}

}  // namespace

CoverCheck validate(const IntrinsicTriangulation& cover, double delaunay_tolerance) {
  CoverCheck check;
  const int sides = static_cast<int>(3 * cover.size());
  if (static_cast<int>(cover.glue.size()) != sides || static_cast<int>(cover.length.size()) != sides) {
    check.not_closed = std::max(1, sides);
    return check;
  }
  for (int side = 0; side < sides; ++side) {
    const int mate = cover.glue[side];
    if (mate < 0 || mate >= sides) {
      ++check.not_closed;
      continue;
    }
    if (mate == side || cover.glue[mate] != side) ++check.not_edge_manifold;
    if (tail(cover, side) != head(cover, mate) || head(cover, side) != tail(cover, mate)) ++check.not_oriented;
    if (cover.length[side] != cover.length[mate]) ++check.unequal_lengths;
    if (side < mate && side / 3 != mate / 3) {
      const double here = oppositeCotan(cover, side), there = oppositeCotan(cover, mate);
      const double sum = here + there;
      check.smallest_cotan_sum = std::min(check.smallest_cotan_sum, sum);
      if (sum < -delaunay_tolerance - needleRounding(cover, side, here) - needleRounding(cover, mate, there))
        ++check.not_delaunay;
    }
  }
  for (int side = 0; side < sides; side += 3) {
    const double a = cover.length[side], b = cover.length[side + 1], c = cover.length[side + 2];
    // Lengths are rounded, so a face flat to the last bits may miss by as much.
    if (!(triangleSlack(a, b, c) >= -4e-16 * (a + b + c))) ++check.triangle_inequality;
  }
  return check;
}

}  // namespace tufted
