#pragma once

#include <optional>
#include <vector>

#include "algorithms/strip.h"

namespace tufted {

/// The way around the point between two pieces of a path, if it has less than half a circle on some side, or would have
/// with the second piece in other triangles that it runs through as well.
/// @returns what takes the place of both, without any piece where the path returns by the way it came
std::optional<std::vector<Segment>> shortcutAt(const MarchFaces& faces, const Segment& before, const Segment& after);

}  // namespace tufted
