#pragma once

#include "tufted/laplacian.h"

namespace tufted {

/// Checks the arrays of a Laplacian and its frames, for functions that need frames and positions.
/// @param function named in messages
/// @throws InvalidInput for arrays of the wrong size, or positions or frames of active points that are not finite
void checkFrames(const char* function, const Laplacian& laplacian, const Frames& frames);

}  // namespace tufted
