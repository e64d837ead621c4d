#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

#include "io/pcd_header.h"

namespace tufted::io {

/// Fill the columns of `header` from the body of a binary or binary_compressed file, after checking that the file is as
/// long as the header says.
/// @param bytes the whole file
/// @returns where the last point ends
std::size_t readPcdBinary(const std::filesystem::path& path, std::string_view bytes, PcdHeader& header);
std::size_t readPcdCompressed(const std::filesystem::path& path, std::string_view bytes, PcdHeader& header);

}  // namespace tufted::io
