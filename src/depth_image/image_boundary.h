#pragma once

#include "base/buffer.h"
#include "base/parallel.h"
#include "depth_image/pixel_window.h"
#include "stars/stars.h"
#include "tufted/types.h"

namespace tufted {

/// Why the surface ends at each point, by rank, from the pixels in the gaps of its star (step 8 in section 28 of
/// docs/algorithm.md): jump if one is on another surface, rim if a gap has none on the same surface, else lost. None
/// where `stars.ends` is 0, lost where no triangle is left.
Buffer<Boundary> findImageBoundary(const Stars& stars, const DepthImage& image, const Workers& workers);

}  // namespace tufted
