#pragma once

#include <cstdint>

#include "base/buffer.h"
#include "base/parallel.h"
#include "base/point_buffer.h"
#include "stars/stars.h"

namespace tufted {

/// Makes stars choose the same diagonal of a quadrilateral.
///
/// The tangent planes of four neighbours p, a, c, b foreshorten their quadrilateral differently. So where it is nearly
/// a rectangle, as on a grid that lies on a curved surface, all four stars may have their far corner in the link: its
/// four triangles then have two votes each, and the union counts 4/3 of its area. Where the surface is a saddle, none
/// of them may, and the union counts 2/3. Of quadrilaterals whose stars disagree the diagonal stays whose opposite
/// corners have the smaller sum of angles in space; of equal ones that which the first of the four points ends, by x,
/// then y, then z. Where the sums differ by more than 0.01 rad, which cells of grids do not, each star keeps what it
/// has. No star changes at a triangle that belongs to two such quadrilaterals, and a closed star keeps three
/// neighbours. All is decided by the stars as they are given, so the result depends on neither order nor threads.
///
/// @param disagrees see findDisagreement(); the four points of such a quadrilateral all do
/// @returns how many quadrilaterals were settled
std::int64_t settleDiagonals(const PointsView& points, const Buffer<std::uint8_t>& disagrees, const Workers& workers,
                             Stars& stars);

}  // namespace tufted
