#pragma once

#include <filesystem>

#include "tufted/laplacian.h"

namespace tufted::io {

/// Checks in O(N) the rules of validate() that need neither a factorisation nor the cover.
/// @param dir the folder that the Laplacian was read from, for errors
/// @param laplacian with arrays of matching sizes, and rows of L that ascend in each column
/// @throws IoError naming the file, the entry and the rule
void requirePromises(const std::filesystem::path& dir, const Laplacian& laplacian);

}  // namespace tufted::io
