#pragma once

#include <optional>
#include <vector>

#include "algorithms/strip.h"

namespace tufted {

/// Leads a path around the other side of the point between two of its pieces, if the angle there is below pi, or is so
/// with the second piece in other triangles that overlap its own (docs/algorithm.md, section 18, paths, step 3).
/// @param keeps_class whether pieces stay in their triangles: laid through others, they may pass a handle on another
/// side
/// @returns the pieces that replace both, none where the path returned along an edge; nullopt if there is no shortcut
std::optional<std::vector<Segment>> shortcutAt(const MarchFaces& faces, const Segment& before, const Segment& after,
                                               bool keeps_class);

}  // namespace tufted
