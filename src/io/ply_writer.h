#pragma once

#include <filesystem>

#include "tufted/io/read.h"
#include "tufted/laplacian.h"

namespace tufted::io {

/// Writes points.ply as documented at writeLaplacian.
/// @param path where the bytes go
/// @param shown the path to name in errors
/// @throws IoError
void writePly(const std::filesystem::path& path, const std::filesystem::path& shown, const Laplacian& laplacian,
              const Geometry& geometry);

}  // namespace tufted::io
