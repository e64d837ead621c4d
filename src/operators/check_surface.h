#pragma once

#include <string>
#include <vector>

#include "tufted/check.h"
#include "tufted/laplacian.h"

namespace tufted {

/// Compares L, M and cover_areas with those computed from the cover. Sizes, the storage of L and the corners of the
/// cover must have been checked.
/// @param[in,out] faults differences are added
SurfaceCheck checkSurface(const Laplacian& laplacian, std::vector<std::string>& faults);

}  // namespace tufted
