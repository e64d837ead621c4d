#pragma once

#include <optional>
#include <vector>

#include "algorithms/strip.h"

namespace tufted {

/// The way around the point between two pieces of a path, if it has less than half a circle on some side.
/// @returns what takes the place of both; none where the path returns along the edge that it came by
std::optional<std::vector<Segment>> shortcutAt(const MarchFaces& faces, const Segment& before, const Segment& after);

}  // namespace tufted
