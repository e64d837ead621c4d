#pragma once

#include <optional>

#include "algorithms/strip.h"

namespace tufted {

/// The triangles along a straight way from a corner of a triangle to a vertex.
/// @param start slot of the corner
/// @param angle radians from the edge to the next corner of the triangle, less than that of the corner
/// @param length of the way
/// @param target the vertex where it is to end
/// @param most_faces after which it gives up; where more than two meet at an edge, each beyond it is tried
/// @returns none if the way does not end there
std::optional<Strip> straightWay(const MarchFaces& faces, int start, double angle, double length, int target,
                                 int most_faces);

}  // namespace tufted
