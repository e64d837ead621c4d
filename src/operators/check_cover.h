#pragma once

#include <string>

#include "tufted/laplacian.h"

namespace tufted {

/// Checks the sizes and corners of a Laplacian's cover, as one that was put together by hand may not fit.
/// @param function how messages call the function that asks
/// @throws InvalidInput where it does not fit, or where there is no cover
void checkCover(const std::string& function, const Laplacian& laplacian);

}  // namespace tufted
