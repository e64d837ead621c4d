#include "cloud/inverted_star.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/pair.h"

namespace tufted {
namespace {

constexpr int most_candidates = 66, most_links = 24;
constexpr int near_part = 12, most_rounds = 3;
/// The sine of the angle between circles from which on they differ: far wider than the tie band of sideOfCircle().
constexpr double distinct = 1e-7;
constexpr double rounding = 1e-14;                          // of coordinates and products of them, a dozen roundings
constexpr double least_square = 1e-60, most_square = 1e60;  // of distances, which keeps all products in range

/// The inverted candidates.
struct Inverted {
  int count = 0;
  std::array<double, most_candidates> x, y;
  std::array<double, most_candidates> size;  ///< |x| + |y|

  double cross(int a, int b) const { return x[a] * y[b] - y[a] * x[b]; }
};

/// False where a point lies too near or too far for the bounds to hold.
bool invert(std::span<const PlanarPoint> candidates, Inverted& points) {
  points.count = static_cast<int>(candidates.size());
  double least = most_square, most = least_square;
  for (int i = 0; i < points.count; ++i) {
    const double u = candidates[i].u, v = candidates[i].v;
    const double square = u * u + v * v, inverse = 1 / square;
    least = std::min(least, square);
    most = std::max(most, square);
    points.x[i] = u * inverse;
    points.y[i] = v * inverse;
    points.size[i] = std::abs(points.x[i]) + std::abs(points.y[i]);
  }
  points.x[points.count] = points.y[points.count] = points.size[points.count] = 0;  // fills the last pair
  return least > least_square && most < most_square;
}

/// Numbers of some candidates.
struct Subset {
  int size = 0;
  std::array<int, most_candidates> of;

  void add(int i) { of[size++] = i; }
};

/// Vertices of a hull, counterclockwise.
struct Hull {
  int size = 0;
  std::array<int, most_links> of;

  int after(int i) const { return of[i + 1 == size ? 0 : i + 1]; }
};

/// The hull of the given points by gift wrapping from the one nearest to the origin of the plane, which comes first.
/// False where it does not come back to that.
bool wrap(const Inverted& points, const Subset& given, Hull& hull) {
  hull.size = 0;
  for (int at = given.of[0]; hull.size < most_links;) {
    hull.of[hull.size++] = at;
    int next = -1;
    double ux = 0, uy = 0;
    for (int j = 0; j < given.size; ++j) {
      const int i = given.of[j];
      const double vx = points.x[i] - points.x[at], vy = points.y[i] - points.y[at];
      // A point on the way itself, at first or where it is `at`, changes nothing.
      if (next < 0 ? i != at : ux * vy - uy * vx < 0) {
        next = i;
        ux = vx;
        uy = vy;
      }
    }
    if (next == given.of[0]) return hull.size >= 3;
    at = next;
  }
  return false;
}

/// Lowers the clearance of each point to that from the edge from a to b: how far it keeps to the left, less what
/// rounding and the tie band may take away.
void lowerClearance(const Inverted& points, int a, int b, std::array<double, most_candidates>& clearance) {
  const double ax = points.x[a], ay = points.y[a];
  const double ux = points.x[b] - ax, uy = points.y[b] - ay;
  const double length = std::abs(ux) + std::abs(uy);
  // A difference is off by the rounding of its ends, and counts times the length of the other.
  const double per_way = distinct * length + rounding * (points.size[a] + points.size[b]);
  const double per_size = rounding * length;
  for (int i = 0; i < points.count; i += 2) {
    const Pair vx = loadPair(&points.x[i]) - ax, vy = loadPair(&points.y[i]) - ay;
    const Pair doubt = (abs(vx) + abs(vy)) * per_way + (points.size[a] + loadPair(&points.size[i])) * per_size;
    storePair(least(loadPair(&clearance[i]), ux * vy - uy * vx - doubt), &clearance[i]);
  }
}

enum class Verdict { certain, incomplete, doubtful };

/// Whether the hull is beyond doubt that of all points with the origin inside. Where points that were not `given` are
/// outside of it or too near, it is incomplete and `given` becomes what the hull must be made of.
Verdict judge(const Inverted& points, const Hull& hull, Subset& given) {
  std::array<double, most_candidates> clearance;
  std::fill_n(clearance.begin(), points.count + points.count % 2, std::numeric_limits<double>::infinity());
  for (int i = 0; i < hull.size; ++i) {
    const int a = hull.of[i], b = hull.after(i);
    if (!(points.cross(a, b) > rounding * points.size[a] * points.size[b])) return Verdict::doubtful;
    const double at_a = clearance[a], at_b = clearance[b];
    lowerClearance(points, a, b, clearance);
    clearance[a] = at_a;
    clearance[b] = at_b;
  }
  for (int j = 0; j < given.size; ++j)
    if (!(std::exchange(clearance[given.of[j]], 1) > 0)) return Verdict::doubtful;
  given.size = 0;
  for (int i = 0; i < hull.size; ++i) given.add(hull.of[i]);
  for (int i = 0; i < points.count; ++i)
    if (!(clearance[i] > 0)) given.add(i);
  return given.size > hull.size ? Verdict::incomplete : Verdict::certain;
}

}  // namespace

bool wrapInverted(std::span<const PlanarPoint> candidates, DelaunayStar& star) {
  if (candidates.size() < 3 || candidates.size() >= most_candidates) return false;
  Inverted points;
  if (!invert(candidates, points)) return false;
  Subset given;
  int nearest = 0;
  for (int i = 1; i < points.count; ++i)
    if (points.size[i] > points.size[nearest]) nearest = i;
  given.add(nearest);
  for (int i = 0; i < std::min(near_part, points.count); ++i)
    if (i != nearest) given.add(i);
  Hull hull;
  Verdict verdict = Verdict::incomplete;
  for (int round = 0; round < most_rounds && verdict == Verdict::incomplete; ++round)
    verdict = wrap(points, given, hull) ? judge(points, hull, given) : Verdict::doubtful;
  if (verdict != Verdict::certain) return false;

  // The link starts at the first vertex counterclockwise from the u axis, where sorting by direction begins.
  int start = 0;
  for (int i = 0; i < hull.size; ++i)
    if (points.y[hull.of[i]] < 0 && points.y[hull.after(i)] >= 0) start = i + 1;
  std::rotate(hull.of.begin(), hull.of.begin() + start % hull.size, hull.of.begin() + hull.size);
  star.closed = true;
  star.link.clear();
  star.radius.clear();
  for (int i = 0; i < hull.size; ++i) {
    star.link.push_back(candidates[hull.of[i]]);
    star.radius.push_back(circumradius(candidates[hull.of[i]], candidates[hull.after(i)]));
  }
  return true;
}

}  // namespace tufted
