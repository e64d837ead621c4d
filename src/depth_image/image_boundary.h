#pragma once

#include "base/buffer.h"
#include "base/parallel.h"
#include "depth_image/pixel_window.h"
#include "stars/stars.h"
#include "tufted/types.h"

namespace tufted {

/// Why the surface ends at each point, by rank, from the pixels in the gaps between its triangles: jump where one shows
/// another surface, rim where a gap holds none of the same surface, else lost. None where `stars.ends` is 0, lost where
/// no triangle is left.
Buffer<Boundary> findImageBoundary(const Stars& stars, const DepthImage& image, const Workers& workers);

}  // namespace tufted
