#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "algorithms/charts.h"
#include "tufted/types.h"

namespace tufted {

/// The sides of a triangle with less slack than this part of its longest side are lengthened, so that its angles are
/// defined. With 1e-8 a plate of 9000 x 2 came out 29 % too short, with 1e-13 no eigenvector is found on some.
constexpr double least_slack = 1e-12;
/// No side is shorter than this part of the longest one.
constexpr double least_side = 1e-8;
/// The longest side of a triangle counts as at least this long, in units of about the longest side of the chart.
constexpr double shortest_side = 1e-12;

/// The binary exponent of the longest side of some triangles; 0 if all sides are 0.
inline int exponentOf(const Points& positions, const std::vector<std::array<int, 3>>& triangles) {
  double longest = 0;
  for (const auto& corners : triangles)
    for (int k = 0; k < 3; ++k)
      longest = std::max(longest, (positions.row(corners[k]) - positions.row(corners[(k + 1) % 3])).stableNorm());
  return longest > 0 ? std::ilogb(longest) : 0;
}

/// Sides and angles of a triangle, lengthened if that is needed for a positive area.
struct TriangleSides {
  std::array<double, 3> opposite;  ///< length of the side opposite each corner, in units of 2^exponent
  std::array<double, 3> cotan;     ///< cotangent of the angle at each corner
  std::array<double, 3> half_tan;  ///< tangent of half the angle at each corner
  double area;                     ///< area before the sides were lengthened, >= 0
};

/// Measures a triangle in units of 2^exponent.
inline TriangleSides measureTriangle(const Points& positions, const std::array<int, 3>& corners, int exponent) {
  TriangleSides sides{};
  std::array<double, 3>& l = sides.opposite;
  for (int k = 0; k < 3; ++k)
    l[k] =
        std::ldexp((positions.row(corners[(k + 1) % 3]) - positions.row(corners[(k + 2) % 3])).stableNorm(), -exponent);
  // Kahan's formula for the area from sorted sides, in which no digits cancel.
  const auto sorted = [&] {
    std::array<double, 3> s = l;
    std::sort(s.begin(), s.end());
    return s;
  };
  const auto areaOf = [](const std::array<double, 3>& s) {
    const auto& [c, b, a] = s;
    return std::sqrt(std::max(0.0, (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c)))) / 4;
  };
  std::array<double, 3> s = sorted();
  sides.area = areaOf(s);
  const double longest = std::max(s[2], shortest_side), slack = s[0] - (s[2] - s[1]);
  if (!(slack >= least_slack * longest))
    for (double& length : l) length += least_slack * longest - std::min(slack, 0.0) - std::max(slack, 0.0);
  for (double& length : l) length = std::max(length, least_side * longest);
  s = sorted();
  if (!(s[0] - (s[2] - s[1]) > 0)) l = {longest, longest, longest};
  const double area = areaOf(sorted());
  for (int k = 0; k < 3; ++k) {
    const double a = l[k], b = l[(k + 1) % 3], c = l[(k + 2) % 3];
    sides.cotan[k] = (b * b + c * c - a * a) / (4 * area);
    sides.half_tan[k] = 4 * area / ((b + c) * (b + c) - a * a);
  }
  return sides;
}

}  // namespace tufted
