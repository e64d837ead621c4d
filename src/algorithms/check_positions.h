#pragma once

#include <string>

#include "tufted/laplacian.h"

namespace tufted {

/// Checks the arrays of a Laplacian, for functions that need its positions.
/// @param function named in errors
/// @throws InvalidInput for arrays of the wrong size, or positions of active points that are not finite
void checkPositions(const std::string& function, const Laplacian& laplacian);

/// Checks frames after checkPositions(), for functions that need both.
/// @throws InvalidInput as checkPositions(), and for frames of the wrong size or frames of active points that are not
/// finite
void checkFrames(const std::string& function, const Laplacian& laplacian, const Frames& frames);

}  // namespace tufted
