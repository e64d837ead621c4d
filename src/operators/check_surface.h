#pragma once

#include <string>
#include <vector>

#include "tufted/check.h"
#include "tufted/laplacian.h"

namespace tufted {

/// Compares L, M and cover_areas with the cover. Their sizes, the storage of L and the corners of the cover are right.
/// @param[out] faults what differs is added
SurfaceCheck checkSurface(const Laplacian& laplacian, std::vector<std::string>& faults);

}  // namespace tufted
