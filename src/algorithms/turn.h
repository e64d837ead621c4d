#pragma once

#include <optional>

#include "algorithms/strip.h"

namespace tufted {

/// What a path may do at a point where one straight piece ends and the next begins.
struct Shortcut {
  bool goes_back = false;  ///< the path returns along the edge that it came by: both pieces fall away
  Strip strip;  ///< otherwise the triangles around the point, from the first piece's start to the second's end
};

/// The shorter way around the point between two pieces of a path, if it has less than half a circle on some side.
std::optional<Shortcut> shortcutAt(const MarchFaces& faces, const Segment& before, const Segment& after);

}  // namespace tufted
