#pragma once

#include <filesystem>

#include "tufted/laplacian.h"

namespace tufted::io {

/// Checks the rules of validate() for a Laplacian, except those that take a factorisation or the cover. O(N).
/// @param dir the folder it was read from, whose files are named
/// @param laplacian its arrays fit each other, and the rows of L ascend in each column
/// @throws IoError naming the file, the entry and the rule
void requirePromises(const std::filesystem::path& dir, const Laplacian& laplacian);

}  // namespace tufted::io
