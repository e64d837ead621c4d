#pragma once

#include <cstddef>
#include <span>

#include "base/point_buffer.h"
#include "neighbors/neighbors.h"

namespace tufted {

/// Leaves out the neighbours of p whose normals are opposed to its own, if together they are higher or lower over p
/// than they and the others are spread: they are on the other side of a thin part (section 4 of docs/algorithm.md), and
/// meet the side of p at no sharp edge within the neighbourhood. Normals of arbitrary signs leave out hardly any.
/// @param normals n x 3, of unit length, 0 if not known; 0 x 3: all stay
/// @param neighbors those that stay come first, in their order
/// @returns how many stay
std::size_t keepOwnSide(const PointsView& points, const PointBuffer& normals, int p, std::span<Neighbor> neighbors);

}  // namespace tufted
