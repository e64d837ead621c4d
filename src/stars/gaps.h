#pragma once

#include <numbers>

#include "base/buffer.h"
#include "stars/stars.h"

namespace tufted {

/// Points farther away than this many longest edges of the star do not count as beyond a gap.
constexpr double farthest_beyond = 2;

/// The positive angle from direction `a` to direction `b`, at most a full turn.
inline double turn(double a, double b) {
  const double angle = b - a;
  return angle > 0 ? angle : angle + 2 * std::numbers::pi;
}

/// A gap between the triangles of a star, counterclockwise.
struct Gap {
  /// share of the gap on either side, which neighbours along its border may reach into
  static constexpr double margin = 0.25;

  double begin = 0;  ///< direction of its first border, rad
  double angle = 0;  ///< (0, 2 pi]

  bool holdsInTheMiddle(double direction) const {
    const double at = turn(begin, direction);
    return at >= margin * angle && at <= (1 - margin) * angle;
  }
};

inline bool hasTriangles(const Stars& stars, int p) {
  for (int i = stars.offset[p]; i < stars.offset[p + 1]; ++i)
    if (stars.hasTriangle(i)) return true;
  return false;
}

/// Calls visit(a, b) with the two link vertices of every triangle of p.
template <class Visit>
void forEachTriangle(const Stars& stars, int p, const Visit& visit) {
  for (int i = stars.offset[p]; i < stars.offset[p + 1]; ++i)
    if (stars.hasTriangle(i)) visit(stars.link[i], stars.link[stars.after(p, i)]);
}

/// Finds the gaps between the triangles of p, which must have at least one.
/// @param direction direction(q): angle of link vertex q seen from p, rad
template <class Direction>
void findGaps(const Stars& stars, int p, const Direction& direction, Buffer<Gap>& gaps) {
  gaps.clear();
  int first = stars.offset[p];
  while (!stars.hasTriangle(first)) ++first;
  int i = first;
  do {
    const int next = stars.after(p, i);
    if (stars.hasTriangle(i)) {
      i = next;
      continue;
    }
    int last = next;
    while (!stars.hasTriangle(last)) last = stars.after(p, last);
    const double begin = direction(stars.link[i]);
    gaps.push_back({begin, turn(begin, direction(stars.link[last]))});
    i = last;
  } while (i != first);
}

}  // namespace tufted
