#pragma once

#include "simd/kernels.h"
#include "simd/packet.h"

namespace tufted {
namespace {

constexpr int most_given = PlanarOffsets::most;
/// Candidates that are wrapped first, two packets (all 30 at once cost 1.3 instead of 0.9 us per point), rounds of
/// adding what lies outside of the hull before the careful way takes over, and the mark of an empty place.
constexpr int near_part = 16, most_rounds = 4, missing = -1;
/// Circles that meet at an angle with at least this sine are distinct: a hundred times the tie band of sideOfCircle().
constexpr double distinct = 1e-7;
/// A point is inside of an edge if it is at least this far from it: a hundred times `distinct`, which also holds for
/// the edge that remains when tied vertices are removed.
constexpr double inside = 1e-5;
/// Below this, a hundredth of the tie band, there is a tie however many differences add up. Between this and `distinct`
/// the order in which vertices are tested may decide.
constexpr double surely_tied = 1e-11;
constexpr double rounding = 1e-14;  // bound on the rounding of coordinates and their products, a dozen operations
// squared distances in this range keep all products in range
constexpr double least_square = 1e-60, most_square = 1e60;

/// The inverted candidates, q / |q|^2.
struct Inverted {
  int count;
  alignas(64) double x[most_given], y[most_given];
};

/// Some of the inverted candidates, with room for whole packets.
struct Subset {
  int size;
  alignas(64) double x[most_given + packet_size], y[most_given + packet_size];
  int of[most_given + packet_size];
};

/// Points by direction from the origin, cyclically: the first is at 1, the last also at 0, and the first again behind
/// the last.
struct Ring {
  int size;
  double x[most_given + 3 * packet_size], y[most_given + 3 * packet_size];
  int of[most_given + 3 * packet_size];

  void close(int copies) {
    x[0] = x[size];
    y[0] = y[size];
    for (int i = 1; i <= copies; ++i) {
      x[size + i] = x[i];
      y[size + i] = y[i];
    }
  }
};

/// Inverts the candidates; false if one is too near or too far for the bounds to hold.
TUFTED_INLINE bool invert(const PlanarOffsets& planar, Inverted& points) {
  points.count = planar.count;
  Packet nearest = broadcast(most_square), furthest = broadcast(least_square);
  for (int i = 0; i < planar.count; i += packet_size) {
    const Mask is_point = firstOf(planar.count - i);
    const Packet u = load(planar.u + i), v = load(planar.v + i);
    const Packet square = select(is_point, u * u + v * v, broadcast(1));
    nearest = min(nearest, square);
    furthest = max(furthest, square);
    const Packet inverse = broadcast(1) / square;
    store(select(is_point, u * inverse, broadcast(0)), points.x + i);
    store(select(is_point, v * inverse, broadcast(0)), points.y + i);
  }
  return reduceMin(nearest) > least_square && reduceMax(furthest) < most_square;
}

/// Sorts points by direction, counterclockwise from the u axis. Of points in one direction only the first is kept.
TUFTED_INLINE void sortByDirection(const Subset& given, Ring& ring) {
  alignas(64) float key[most_given + float_packet_size];  // a pseudo-angle, 0 to 4
  for (int i = 0; i < given.size; i += packet_size) {
    const Packet x = load(given.x + i), y = load(given.y + i);
    const Packet turn = x / (absolute(x) + absolute(y));
    storeFloats(select(isLess(y, broadcast(0)), broadcast(3) + turn, broadcast(1) - turn), key + i);
  }
  alignas(64) int rank[most_given + float_packet_size];
  for (int i = 0; i < given.size; i += float_packet_size) rankFloats<1>(key + i, key, given.size, rank + i);
  for (int i = 1; i <= given.size; ++i) ring.of[i] = missing;
  int sum = 0;
  for (int i = given.size - 1; i >= 0; --i) {
    const int at = 1 + rank[i];
    sum += rank[i];
    ring.x[at] = given.x[i];
    ring.y[at] = given.y[i];
    ring.of[at] = given.of[i];
  }
  ring.size = given.size;
  if (sum == given.size * (given.size - 1) / 2) return;
  ring.size = 0;  // equal directions have left places empty
  for (int i = 1; i <= given.size; ++i) {
    if (ring.of[i] == missing) continue;
    const int at = ++ring.size;
    ring.x[at] = ring.x[i];
    ring.y[at] = ring.y[i];
    ring.of[at] = ring.of[i];
  }
}

/// Removes all vertices where the ring does not turn left, until it turns left everywhere. Such a vertex lies in the
/// triangle of the origin and its neighbours, even if these are removed, so it is no vertex of the hull.
TUFTED_INLINE void removeReflex(Ring& first, Ring& second, Ring*& hull) {
  Ring *ring = &first, *next = &second;
  for (;;) {
    ring->close(1);
    int kept = 1;
    for (int i = 0; i < ring->size; i += packet_size) {
      const Packet ax = load(ring->x + i), ay = load(ring->y + i);
      const Packet bx = load(ring->x + i + 1), by = load(ring->y + i + 1);
      const Packet cx = load(ring->x + i + 2), cy = load(ring->y + i + 2);
      const Mask turns_left = isLess((by - ay) * (cx - bx), (bx - ax) * (cy - by));
      const Mask stays = logicalAnd(turns_left, firstOf(ring->size - i));
      compress(stays, bx, next->x + kept);
      compress(stays, by, next->y + kept);
      compress(stays, ring->of + i + 1, next->of + kept);
      kept += countOf(stays);
    }
    next->size = kept - 1;
    Ring* const before = ring;
    ring = next;
    next = before;
    if (ring->size < 3 || ring->size == before->size) break;
  }
  hull = ring;
}

enum class Verdict { certain, tied, incomplete, open, doubtful };

/// The edges of a hull. The line through an edge is dual . x = 1, with dual . x < 1 inside.
struct Edges {
  int count;
  alignas(64) double dual_x[InvertedStar::most], dual_y[InvertedStar::most];
  bool is_open;       ///< whether the origin is not inside of all edges
  bool has_ties;      ///< whether the hull turns by less than `distinct` at a vertex
  bool is_ambiguous;  ///< whether it also turns by more than `surely_tied` there
  double ratio;       ///< the distance of the farthest vertex over that of the nearest edge
  double limit;       ///< points with a larger dual . x are too near to an edge
};

/// @param[out] radius circumradius of each triangle, before inversion
TUFTED_INLINE void measureEdges(Ring& hull, Edges& edges, double* radius) {
  hull.close(toPackets(hull.size) - hull.size + 2);
  edges.count = hull.size;
  Mask is_open = none(), is_tied = none(), is_ambiguous = none();
  Packet inner_square = broadcast(most_square), least_cross = broadcast(most_square), most_size = broadcast(0);
  for (int i = 0; i < hull.size; i += packet_size) {
    const Packet ax = load(hull.x + i + 1), ay = load(hull.y + i + 1);
    const Packet bx = load(hull.x + i + 2), by = load(hull.y + i + 2);
    const Packet cx = load(hull.x + i + 3), cy = load(hull.y + i + 3);
    const Packet ux = bx - ax, uy = by - ay, vx = cx - bx, vy = cy - by;
    const Packet u = absolute(ux) + absolute(uy), v = absolute(vx) + absolute(vy);
    const Packet a = absolute(ax) + absolute(ay), b = absolute(bx) + absolute(by), c = absolute(cx) + absolute(cy);
    // A difference is wrong by the rounding of its two ends, times the length of the other factor.
    const Packet doubt = broadcast(distinct) * u * v + broadcast(rounding) * ((a + b) * v + (b + c) * u);
    const Packet cross = ax * by - ay * bx, turn = ux * vy - uy * vx;
    const Mask turns_little = isAtMost(turn, doubt);
    is_open = logicalOr(is_open, isAtMost(cross, broadcast(0)));
    is_tied = logicalOr(is_tied, turns_little);
    is_ambiguous = logicalOr(is_ambiguous, logicalAnd(turns_little, isLess(broadcast(surely_tied) * u * v, turn)));
    store(uy / cross, edges.dual_x + i);
    store(-ux / cross, edges.dual_y + i);
    const Packet square = cross * cross / (ux * ux + uy * uy);  // squared distance from the origin to the edge
    inner_square = min(inner_square, square);
    least_cross = min(least_cross, cross);
    most_size = max(most_size, a);
    store(broadcast(0.5) / squareRoot(square), radius + i);
  }
  const double size = reduceMax(most_size);
  edges.is_open = any(is_open);
  edges.has_ties = any(is_tied);
  edges.is_ambiguous = any(is_ambiguous);
  edges.ratio = size / __builtin_sqrt(reduceMin(inner_square));
  edges.limit = 1 - 2 * inside * edges.ratio - rounding * size * size / reduceMin(least_cross);
}

/// The gauge of each point, max dual . x over all edges: below 1 inside of the hull, above 1 outside; set to 0 for its
/// vertices. Returns the largest.
TUFTED_INLINE double gaugePoints(const Inverted& points, const Ring& hull, const Edges& edges, double* gauge) {
  for (int i = 0; i < points.count; i += packet_size) {
    const Packet x = load(points.x + i), y = load(points.y + i);
    Packet largest = broadcast(0);
    for (int e = 0; e < edges.count; ++e)
      largest = max(largest, x * broadcast(edges.dual_x[e]) + y * broadcast(edges.dual_y[e]));
    store(largest, gauge + i);
  }
  for (int i = 1; i <= hull.size; ++i) gauge[hull.of[i]] = 0;
  Packet outermost = broadcast(0);
  for (int i = 0; i < points.count; i += packet_size) outermost = max(outermost, load(gauge + i));
  return reduceMax(outermost);
}

/// Whether it is uncertain for any point if it is tied with the ends of an edge.
TUFTED_INLINE bool isAmbiguous(const Inverted& points, const double* gauge, double ratio) {
  const Packet from = broadcast(1 - distinct * ratio), to = broadcast(1 - surely_tied * ratio);
  Mask is_ambiguous = none();
  for (int i = 0; i < points.count; i += packet_size) {
    const Packet value = load(gauge + i);
    is_ambiguous = logicalOr(is_ambiguous, logicalAnd(isLess(from, value), isLess(value, to)));
  }
  return any(is_ambiguous);
}

TUFTED_INLINE void takeVertices(const Ring& hull, InvertedStar& star) {
  star.size = hull.size;
  for (int i = 0; i < hull.size; ++i) star.link[i] = hull.of[i + 1];
}

/// Sets `given` to the vertices of the hull and all points outside or too near, by ascending distance. Returns whether
/// all of them were given before.
TUFTED_INLINE bool takeCandidates(const Inverted& points, const double* gauge, double limit, const bool* is_vertex,
                                  Subset& given) {
  bool was_given[most_given] = {};
  for (int i = 0; i < given.size; ++i) was_given[given.of[i]] = true;
  bool is_complete = true;
  given.size = 0;
  for (int i = 0; i < points.count; ++i) {
    if (gauge[i] < limit && !is_vertex[i]) continue;
    is_complete &= was_given[i];
    given.x[given.size] = points.x[i];
    given.y[given.size] = points.y[i];
    given.of[given.size++] = i;
  }
  return is_complete;
}

/// Judges the hull. It is certain if it is the hull of all points, has the origin inside and no ties. If points that
/// were not given are outside or too near, it is incomplete, and `given` becomes the points for the next hull. If only
/// given points are too near, the star is tied, and `link` becomes all points that may be in it. If the origin is
/// outside, or too near to the hull, it is open.
///
/// Proof. In direction between two vertices of the hull, any link that delaunayStar() is left with turns inwards at the
/// one vertex and returns at the other. If every point is seen from both at more than the angle `distinct` to their
/// edge, one of the link vertices in between turns the wrong way by far more than the tie band, so all are removed; the
/// vertices of the hull, which turn by more than that, are not. Points must keep `inside` instead of `distinct`, which
/// also holds for the edge that remains when tied vertices of the hull are removed.
TUFTED_INLINE Verdict judge(const Inverted& points, Ring& hull, Subset& given, InvertedStar& star) {
  if (hull.size < 3) return Verdict::open;
  if (hull.size > InvertedStar::most) return Verdict::doubtful;
  Edges edges;
  measureEdges(hull, edges, star.radius);
  if (edges.is_open || !(edges.limit > 0)) return Verdict::open;

  alignas(64) double gauge[most_given];
  const double outermost = gaugePoints(points, hull, edges, gauge);
  if (outermost < edges.limit && !edges.has_ties) {
    takeVertices(hull, star);
    return Verdict::certain;
  }
  if (edges.is_ambiguous || isAmbiguous(points, gauge, edges.ratio)) return Verdict::doubtful;

  bool is_vertex[most_given] = {};
  for (int i = 1; i <= hull.size; ++i) is_vertex[hull.of[i]] = true;
  if (!takeCandidates(points, gauge, edges.limit, is_vertex, given)) return Verdict::incomplete;
  if (given.size > InvertedStar::most) return Verdict::doubtful;
  takeVertices(hull, star);
  for (int i = 0; i < given.size; ++i)
    if (!is_vertex[given.of[i]]) star.link[star.size++] = given.of[i];
  return Verdict::tied;
}

TUFTED_INLINE void giveFirst(const Inverted& points, int count, Subset& given) {
  given.size = count;
  for (int i = 0; i < count; i += packet_size) {
    store(load(points.x + i), given.x + i);
    store(load(points.y + i), given.y + i);
    for (int j = i; j < i + packet_size; ++j) given.of[j] = j;
  }
}

StarKind wrapInvertedPackets(const PlanarOffsets& planar, InvertedStar& star) {
  if (planar.count < 3) return StarKind::unknown;
  Inverted points;
  if (!invert(planar, points)) return StarKind::unknown;
  Subset given;
  giveFirst(points, points.count < near_part ? points.count : near_part, given);
  Verdict verdict = Verdict::incomplete;
  for (int round = 0; round < most_rounds && verdict == Verdict::incomplete; ++round) {
    Ring first, second, *hull = nullptr;
    const bool are_all = given.size == points.count;
    sortByDirection(given, first);
    removeReflex(first, second, hull);
    verdict = judge(points, *hull, given, star);
    if (verdict == Verdict::open && !are_all) {
      giveFirst(points, points.count, given);
      verdict = Verdict::incomplete;
    }
  }
  switch (verdict) {
    case Verdict::certain:
      return StarKind::closed;
    case Verdict::tied:
      return StarKind::tied;
    case Verdict::open:
      return StarKind::gaping;
    default:
      return StarKind::unknown;
  }
}

}  // namespace
}  // namespace tufted
