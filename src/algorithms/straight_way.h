#pragma once

#include <optional>

#include "algorithms/strip.h"

namespace tufted {

/// The triangles along the straight way of a length from a corner of a face, if it comes to a vertex.
/// @param angle between it and the side opposite the corner before, up to that of the corner
/// @param target the vertex
/// @param most_faces so many are looked at: where more than two meet at an edge, one beyond it after the other
std::optional<Strip> straightWay(const MarchFaces& faces, int start, double angle, double length, int target,
                                 int most_faces);

}  // namespace tufted
