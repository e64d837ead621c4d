#pragma once

#include <optional>

#include "algorithms/strip.h"

namespace tufted {

/// The triangles along a straight line from a corner of a triangle to a vertex (docs/algorithm.md, section 18).
/// @param start slot of the corner
/// @param angle from the edge to the next corner of the triangle, radians, within the angle of the corner
/// @param length of the line
/// @param target vertex at the end of the line
/// @param most_faces maximum number of triangles to try; where more than two meet at an edge, each is tried
/// @returns nullopt if the line does not end at `target`
std::optional<Strip> straightWay(const MarchFaces& faces, int start, double angle, double length, int target,
                                 int most_faces);

}  // namespace tufted
