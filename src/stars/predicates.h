#pragma once

namespace tufted {

/// A neighbour projected to the tangent plane of p, which is at the origin.
struct PlanarPoint {
  double u, v;
  int index;  ///< rank
};

/// Sign of the turn from a to b seen from the origin: 1 counterclockwise, -1 clockwise, 0 collinear. Exact.
int orientation(const PlanarPoint& a, const PlanarPoint& b);

/// Position of c relative to the circle through the origin, a and b (counterclockwise).
enum class CircleSide { outside, tie, inside };

/// In-circle test with a tie band (*The test* in section 6 of docs/algorithm.md): `tie` if the angles at the origin and
/// at b of the quadrilateral (origin, a, b, c) sum to pi within 1e-9 rad. Rounding of the double test is a million
/// times narrower than the band, so its sign is right outside of it. If all four points are nearly collinear, or
/// products may underflow, CGAL's exact predicate decides, and only its zero is a tie.
CircleSide sideOfCircle(const PlanarPoint& a, const PlanarPoint& b, const PlanarPoint& c);

}  // namespace tufted
