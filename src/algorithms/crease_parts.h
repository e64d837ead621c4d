#pragma once

#include <vector>

#include "tufted/segments.h"

namespace tufted {

/// The parts between concave creases, see SegmentMethod::parts.
/// @param frames N x 3 each, turned by orientedFrames() if their signs are arbitrary
/// @return labels, 0 for the part of the most points; -1 at points that are not active
std::vector<int> creaseParts(const Laplacian& laplacian, const Frames& frames, const SegmentOptions& options);

}  // namespace tufted
