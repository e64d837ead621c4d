#pragma once

// Angles and areas from edge lengths only (Sections 3.2 and 3.3), in double or long double.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "base/power_of_two.h"
#include "tufted/intrinsic_triangulation.h"

namespace tufted {

/// A triangle whose slack is less than this share of its longest side is flat: at 2^-46 rounding of the three lengths
/// changes the slack by 1/128, and the height is about 1e-7 of the longest side.
constexpr double flat_slack = 0x1p-46;

/// Slack of the triangle inequality, shortest + middle - longest, in Kahan's order of operations, which is accurate.
template <class Real>
Real triangleSlack(Real a, Real b, Real c) {
  if (a < b) std::swap(a, b);
  if (b < c) std::swap(b, c);
  if (a < b) std::swap(a, b);
  return c - (a - b);
}

/// Area by Heron's formula after Kahan, accurate for needles; 0 if the lengths violate the triangle inequality.
template <class Real>
Real triangleArea(Real a, Real b, Real c) {
  if (a < b) std::swap(a, b);
  if (b < c) std::swap(b, c);
  if (a < b) std::swap(a, b);
  const Real square = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
  return square > 0 ? std::sqrt(square) / 4 : 0;
}

/// b^2 + c^2 - a^2; negative exactly where the angle opposite a is obtuse, and bit for bit the same with b and c
/// exchanged.
template <class Real>
Real cotanNumerator(Real a, Real b, Real c) {
  const Real shorter = std::min(b, c), longer = std::max(b, c);
  return shorter * shorter + (longer - a) * (longer + a);
}

/// Cotangent of the angle opposite a. Infinite or NaN if the triangle has no area.
template <class Real>
Real oppositeCotan(Real a, Real b, Real c) {
  return cotanNumerator(a, b, c) / (4 * triangleArea(a, b, c));
}

/// Cotangent of the angle opposite `side` in its face. Infinite or NaN if the face has no area.
template <class Triangulation>
auto oppositeCotan(const Triangulation& t, int side) {
  return oppositeCotan(t.length[side], t.length[nextSide(side)], t.length[previousSide(side)]);
}

/// Whether the angle opposite `side` in its face is obtuse.
template <class Triangulation>
bool isOppositeObtuse(const Triangulation& t, int side) {
  return cotanNumerator(t.length[side], t.length[nextSide(side)], t.length[previousSide(side)]) < 0;
}

template <class Triangulation>
double faceArea(const Triangulation& t, int face) {
  return triangleArea(t.length[3 * face], t.length[3 * face + 1], t.length[3 * face + 2]);
}

/// The lengths of a face divided by a power of two, so that the longest lies in [1, 2): what is computed from them
/// neither overflows nor underflows, whatever the unit of the lengths is.
struct UnitFace {
  std::array<double, 3> length;
  double unit;  ///< the power of two that the lengths were divided by

  double area() const { return triangleArea(length[0], length[1], length[2]); }
  /// Whether a length is so small that it has lost digits: below 2^-970, 1e-292. validate() does not judge such faces.
  bool isCoarse() const {
    constexpr double smallest = 0x1p-970;
    return std::any_of(length.begin(), length.end(), [this](double l) { return l > 0 && l * unit < smallest; });
  }
  /// Cotangent of the angle opposite side `s`. Infinite or NaN if the face has no area.
  double cotan(int s) const { return oppositeCotan(length[s], length[(s + 1) % 3], length[(s + 2) % 3]); }
};

inline UnitFace unitFace(const IntrinsicTriangulation& t, std::int64_t face) {
  const double* const side = t.length.data() + 3 * face;
  const double unit = magnitudeOf(std::max({side[0], side[1], side[2]}));
  return {{side[0] / unit, side[1] / unit, side[2] / unit}, unit};
}

/// First corner of a side; head() is the last one.
template <class Triangulation>
int tail(const Triangulation& t, int side) {
  return t.faces[side / 3][side % 3];
}
template <class Triangulation>
int head(const Triangulation& t, int side) {
  return t.faces[side / 3][nextSide(side) % 3];
}

}  // namespace tufted
