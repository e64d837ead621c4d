#pragma once

#include "simd/kernels.h"
#include "simd/packet.h"
#include "simd/star_by_inversion.h"

namespace tufted {
namespace {

/// There is no plane if the sine between the changes of positions with rows and with columns is below this.
constexpr double least_sine = 1e-6;
/// Ring 3 is this many times as far as ring 2, as in isCertain() of image_stars.cpp.
constexpr double next_ring = 3.0 / 2;
/// Number of diagonally adjacent pixels.
constexpr int corners = pixels_beside / 2;

struct VectorPart {
  Part x, y, z;
};
TUFTED_INLINE VectorPart plus(const VectorPart& a, const VectorPart& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
TUFTED_INLINE VectorPart times(Part scale, const VectorPart& a) {
  return {scale * a.x, scale * a.y, scale * a.z};
}
TUFTED_INLINE Part dot(const VectorPart& a, const VectorPart& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
TUFTED_INLINE VectorPart cross(const VectorPart& a, const VectorPart& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

struct PlanarPart {
  Part x, y;
};
TUFTED_INLINE PlanarPart select(PartMask mask, const PlanarPart& a, const PlanarPart& b) {
  return {select(mask, a.x, b.x), select(mask, a.y, b.y)};
}
TUFTED_INLINE Part sizeOf(const PlanarPart& a) {
  return absolute(a.x) + absolute(a.y);
}

/// An edge of the hull of inverted points, counterclockwise; one star per lane.
struct EdgePart {
  PlanarPart from, to, along;
};
TUFTED_INLINE EdgePart edgeBetween(const PlanarPart& from, const PlanarPart& to) {
  return {from, to, {to.x - from.x, to.y - from.y}};
}

/// Whether the hull certainly turns left from one edge to the next, with the bound of measureEdges().
TUFTED_INLINE PartMask turnsLeft(const EdgePart& first, const EdgePart& second) {
  const Part u = sizeOf(first.along), v = sizeOf(second.along);
  const Part a = sizeOf(first.from), b = sizeOf(first.to), c = sizeOf(second.to);
  const Part doubt = broadcastPart(distinct) * u * v + broadcastPart(rounding) * ((a + b) * v + (b + c) * u);
  return isLess(doubt, first.along.x * second.along.y - first.along.y * second.along.x);
}

/// The plane spanned by the changes of positions with rows and with columns.
struct PlaneOfPixels {
  VectorPart normal, x, y;  ///< y is x turned by pi / 2 towards growing columns
  PartMask is_found;
};

TUFTED_INLINE PlaneOfPixels planeOfPixels(const VectorPart* offset) {
  const Part zero = broadcastPart(0);
  VectorPart by_row = {zero, zero, zero}, by_column = by_row;
  for (int i = 0; i < pixels_around; ++i) {
    by_row = plus(by_row, times(broadcastPart(around_row[i]), offset[i]));
    by_column = plus(by_column, times(broadcastPart(around_column[i]), offset[i]));
  }
  const Part least = broadcastPart(least_square), most = broadcastPart(most_square);
  const Part rows = dot(by_row, by_row), columns = dot(by_column, by_column);
  const VectorPart normal = cross(by_row, by_column);
  const Part square = dot(normal, normal);
  const PartMask is_in_range = logicalAnd(isLess(least, min(rows, columns)), isLess(max(rows, columns), most));
  const PartMask is_wide = isLess(broadcastPart(least_sine * least_sine) * rows * columns, square);
  PlaneOfPixels plane;
  plane.is_found = logicalAnd(is_in_range, is_wide);
  plane.normal = times(broadcastPart(1) / squareRoot(square), normal);
  plane.x = times(broadcastPart(1) / squareRoot(rows), by_row);
  plane.y = cross(plane.normal, plane.x);
  return plane;
}

/// The projected and inverted points.
struct InvertedPixels {
  PlanarPart point[pixels_around];
  /// squared distance in space to the nearest point of ring 2, or of its two rows if `is_stretched`
  Part nearest_of_ring;
  PartMask is_in_range;
};

TUFTED_INLINE InvertedPixels invertPixels(const VectorPart* offset, const PlaneOfPixels& plane, bool is_stretched,
                                          int part, PixelStars& stars) {
  const Part least = broadcastPart(least_square), most = broadcastPart(most_square);
  InvertedPixels inverted;
  Part nearest = most, furthest = least, squares = broadcastPart(0);
  inverted.nearest_of_ring = most;
  for (int i = 0; i < pixels_around; ++i) {
    const Part u = dot(offset[i], plane.x), v = dot(offset[i], plane.y), h = dot(offset[i], plane.normal);
    const Part square = u * u + v * v, in_space = square + h * h;
    squares = squares + in_space;
    nearest = min(nearest, square);
    furthest = max(furthest, square);
    const bool is_next = i >= pixels_beside && (!is_stretched || around_row[i] == 2 || around_row[i] == -2);
    if (is_next) inverted.nearest_of_ring = min(inverted.nearest_of_ring, in_space);
    const Part inverse = broadcastPart(1) / square;
    inverted.point[i] = {u * inverse, v * inverse};
  }
  inverted.is_in_range = logicalAnd(isLess(least, nearest), isLess(furthest, most));

  // frameOf() of pixel_frame.cpp computes the same radius for one point.
  store(squareRoot(broadcastPart(2.0 / pixels_around) * squares), stars.fit_radius + part);
  return inverted;
}

/// The hull of the pixels above, below, left and right, and of diagonal ones outside of their edges. Returns the lanes
/// where it is certainly the hull of all points, as in judge(), and no circle reaches ring 3.
TUFTED_INLINE PartMask hullOfPixels(const InvertedPixels& pixels, int part, PixelStars& stars) {
  const PlanarPart* const point = pixels.point;
  EdgePart edge[pixels_beside];
  PartMask has_corner[corners];
  PartMask is_hull = pixels.is_in_range;
  for (int c = 0; c < corners; ++c) {
    const PlanarPart &from = point[2 * c], &corner = point[2 * c + 1], &to = point[(2 * c + 2) % pixels_beside];
    const EdgePart in = edgeBetween(from, corner), out = edgeBetween(corner, to);
    has_corner[c] = turnsLeft(in, out);
    stars.has_corner[c] |= bitsOf(has_corner[c]) << part;
    edge[2 * c] = edgeBetween(from, select(has_corner[c], corner, to));
    edge[2 * c + 1] = edgeBetween(select(has_corner[c], corner, from), to);
  }
  for (int c = 0; c < corners; ++c)
    is_hull = logicalAnd(is_hull, turnsLeft(edge[2 * c + 1], edge[(2 * c + 2) % pixels_beside]));

  PlanarPart dual[pixels_beside];
  Part inner_square = broadcastPart(most_square), least_cross = inner_square, size = broadcastPart(0);
  for (int e = 0; e < pixels_beside; ++e) {
    const auto& [from, to, along] = edge[e];
    const Part cross = from.x * to.y - from.y * to.x;
    const Part square = cross * cross / (along.x * along.x + along.y * along.y);
    const Part inverse = broadcastPart(1) / cross;
    dual[e] = {along.y * inverse, -along.x * inverse};
    inner_square = min(inner_square, square);
    least_cross = min(least_cross, cross);
    size = max(size, sizeOf(from));
    store(broadcastPart(0.5) / squareRoot(square), stars.radius[e] + part);
  }
  // Each of its four quarters spans less than half a turn, so it goes around once.
  for (int c = 0; c < corners; ++c) {
    const PlanarPart &from = point[2 * c], &to = point[(2 * c + 2) % pixels_beside];
    least_cross = min(least_cross, from.x * to.y - from.y * to.x);
  }
  const Part inner = squareRoot(inner_square);
  const Part limit = broadcastPart(1) - broadcastPart(2 * inside) * (size / inner) -
                     broadcastPart(rounding) * size * size / least_cross;
  is_hull = logicalAnd(is_hull, logicalAnd(isLess(broadcastPart(0), least_cross), isLess(broadcastPart(0), limit)));

  Part outermost = broadcastPart(0);
  const auto gauge = [&](const PlanarPart& q) {
    Part largest = broadcastPart(0);
    for (const PlanarPart& d : dual) largest = max(largest, q.x * d.x + q.y * d.y);
    return largest;
  };
  for (int c = 0; c < corners; ++c)
    outermost = max(outermost, select(has_corner[c], broadcastPart(0), gauge(point[2 * c + 1])));
  for (int i = pixels_beside; i < pixels_around; ++i) outermost = max(outermost, gauge(point[i]));
  is_hull = logicalAnd(is_hull, isLess(outermost, limit));
  // The widest circle, of diameter 1 / inner, must end before ring 3.
  const Part next = broadcastPart(next_ring * next_ring) * pixels.nearest_of_ring;
  return logicalAnd(is_hull, isLess(broadcastPart(1), next * inner_square));
}

void wrapPixels(const PixelsAround& around, PixelStars& stars) {
  stars.is_found = stars.is_mirrored = stars.is_certain = 0;
  for (unsigned& corner : stars.has_corner) corner = 0;
  for (int part = 0; part < packet_size; part += part_size) {
    VectorPart offset[pixels_around];
    for (int i = 0; i < pixels_around; ++i)
      offset[i] = {loadPart(around.x[i] + part), loadPart(around.y[i] + part), loadPart(around.z[i] + part)};
    const PlaneOfPixels plane = planeOfPixels(offset);
    const VectorPart sight = {loadPart(around.sight_x + part), loadPart(around.sight_y + part),
                              loadPart(around.sight_z + part)};
    const Part zero = broadcastPart(0);
    const PartMask is_away = isLess(zero, dot(plane.normal, sight));
    store(select(is_away, zero - plane.normal.x, plane.normal.x), stars.normal_x + part);
    store(select(is_away, zero - plane.normal.y, plane.normal.y), stars.normal_y + part);
    store(select(is_away, zero - plane.normal.z, plane.normal.z), stars.normal_z + part);
    const InvertedPixels inverted = invertPixels(offset, plane, around.is_stretched, part, stars);
    const PartMask is_hull = hullOfPixels(inverted, part, stars);
    stars.is_found |= bitsOf(plane.is_found) << part;
    stars.is_mirrored |= bitsOf(is_away) << part;
    stars.is_certain |= bitsOf(logicalAnd(plane.is_found, is_hull)) << part;
  }
}

}  // namespace
}  // namespace tufted
