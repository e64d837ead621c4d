#pragma once

#include <cmath>
#include <utility>

namespace tufted {

/// A triangle of vertex a and two others, by its lengths.
struct MarchTriangle {
  int b, c;
  double ab, ac, bc;
  double double_area;
  bool is_bent;  ///< see MarchFace
};

/// Distance of c from a source with given distances from a and b: the source is unfolded into the plane of the
/// triangle, to the other side of ab. Infinite if there is no such source, or if it does not see c through ab.
/// Exchanging a and b gives the same bits.
/// @param must_see false: the plane of the triangle is extended beyond a and b
inline double distanceThrough(double ab, double ac, double bc, double double_area, double from_a, double from_b,
                              bool must_see = true) {
  if (from_b < from_a || (from_b == from_a && bc < ac)) {
    std::swap(from_a, from_b);
    std::swap(ac, bc);
  }
  // Coordinates along ab from a, and across it.
  const double inverse = 1 / ab;
  const double source_x = (ab - (from_b - from_a) * ((from_b + from_a) * inverse)) / 2;
  const double square = (from_a - source_x) * (from_a + source_x);
  if (!(square >= 0)) return HUGE_VAL;
  const double source_y = std::sqrt(square);
  const double c_x = (ab + (ac - bc) * ((ac + bc) * inverse)) / 2, c_y = double_area * inverse;
  const double across = source_y + c_y, along = c_x - source_x;
  const double crossing = source_x * across + along * source_y;  // place on ab, times `across`
  if (must_see && !(crossing >= 0 && crossing <= ab * across)) return HUGE_VAL;
  return std::sqrt(along * along + across * across);
}

}  // namespace tufted
