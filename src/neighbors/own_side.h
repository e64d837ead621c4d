#pragma once

#include "base/buffer.h"
#include "base/point_buffer.h"
#include "neighbors/neighbors.h"

namespace tufted {

/// Removes the neighbours of p whose normals are opposed to its own, if together they are higher or lower over p than
/// they and the others are spread: they are on the other side of a thin part (section 4 of docs/algorithm.md), and meet
/// the side of p at no sharp edge within the neighbourhood. Normals of arbitrary signs remove hardly any.
/// @param normals n x 3, of unit length, 0 if not known; 0 x 3: none is removed
void keepOwnSide(const PointsView& points, const PointBuffer& normals, int p, Buffer<Neighbor>& neighbors);

}  // namespace tufted
