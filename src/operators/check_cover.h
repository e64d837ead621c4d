#pragma once

#include <string>

#include "tufted/laplacian.h"

namespace tufted {

/// Checks the sizes and corners of a Laplacian's cover, which a caller may have assembled wrongly.
/// @param function named in errors
/// @throws InvalidInput if they do not fit the Laplacian, or there is no cover
void checkCover(const std::string& function, const Laplacian& laplacian);

}  // namespace tufted
