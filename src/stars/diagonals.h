#pragma once

#include <cstdint>

#include "base/buffer.h"
#include "base/parallel.h"
#include "base/point_buffer.h"
#include "stars/stars.h"

namespace tufted {

/// Makes stars choose the same diagonal of a quadrilateral (*Diagonals* in section 7 of docs/algorithm.md).
///
/// The tangent planes of four neighbours foreshorten their quadrilateral differently. Where it is nearly a rectangle,
/// as on a grid on a curved surface, all four stars may contain their far corner, so that the union counts 4/3 of the
/// area; on a saddle none may, so that it counts 2/3. Of both diagonals the one is chosen whose opposite corners have
/// the smaller sum of angles in space; if the sums are equal, the one that ends at the least of the four points, by x,
/// then y, then z. If the sums differ by more than 0.01 rad, which those of grid cells do not, each star keeps its own.
/// A quadrilateral is left as it is if it shares a triangle of a star with another one, or if a closed star would have
/// fewer than three neighbours. All decisions use the stars as given, so the result depends on neither order nor
/// threads.
///
/// @param disagrees see findDisagreement(); all four points of such a quadrilateral disagree
/// @returns the number of quadrilaterals that were changed
std::int64_t settleDiagonals(const PointsView& points, const Buffer<std::uint8_t>& disagrees, const Workers& workers,
                             Stars& stars);

}  // namespace tufted
