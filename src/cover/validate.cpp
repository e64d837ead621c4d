#include <algorithm>
#include <cmath>
#include <limits>

#include "cover/cotan_rounding.h"
#include "cover/geometry.h"
#include "tufted/intrinsic_triangulation.h"

namespace tufted {
namespace {

/// Equation 2 for the cotangents opposite an edge, up to the tolerance and the rounding that flips leave. A sum that is
/// not a number, at a face without area, counts as Delaunay.
bool isDelaunay(double here, double there, double tolerance) {
  const double sum = here + there;
  if (std::isinf(sum)) return sum > 0;
  return !isBelowRounding(here, there, tolerance, 1.01 * cotan_tolerance);
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
      const UnitFace face = unitFace(cover, side / 3), other = unitFace(cover, mate / 3);
      if (face.isCoarse() || other.isCoarse()) continue;
      const double here = face.cotan(side % 3), there = other.cotan(mate % 3);
      check.smallest_cotan_sum = std::min(check.smallest_cotan_sum, here + there);
      if (!isDelaunay(here, there, delaunay_tolerance)) ++check.not_delaunay;
    }
  }
  for (int side = 0; side < sides; side += 3) {
    const double a = cover.length[side], b = cover.length[side + 1], c = cover.length[side + 2];
    // The lengths of a flat face may violate the inequality by their rounding.
    const double rounding = 4e-16 * (a + b + c) + 4 * std::numeric_limits<double>::denorm_min();
    if (!(triangleSlack(a, b, c) >= -rounding)) ++check.triangle_inequality;
  }
  return check;
}

}  // namespace tufted
