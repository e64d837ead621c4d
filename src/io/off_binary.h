#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "tufted/io/read.h"

namespace tufted::io {

/// Reads the binary form of OFF (big endian floats) through CGAL.
/// @param bytes the whole file
/// @param body where the binary counts begin
/// @throws IoError naming the path and byte
Geometry readBinaryOff(const std::filesystem::path& path, std::string bytes, std::size_t body);

}  // namespace tufted::io
