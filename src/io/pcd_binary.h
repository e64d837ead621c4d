#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

#include "io/pcd_header.h"

namespace tufted::io {

/// Checks that a binary file is as long as its header says, and reads its values into the columns of `header`.
/// readPcdCompressed() does so for binary_compressed files.
/// @param bytes the whole file
/// @return byte at which the last point ends
/// @throws IoError naming the path and byte
std::size_t readPcdBinary(const std::filesystem::path& path, std::string_view bytes, PcdHeader& header);
std::size_t readPcdCompressed(const std::filesystem::path& path, std::string_view bytes, PcdHeader& header);

}  // namespace tufted::io
