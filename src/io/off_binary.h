#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

#include "io/off_layout.h"
#include "tufted/io/read.h"

namespace tufted::io {

/// Reads the binary form of OFF, 32-bit integers and floats: big endian by the standard, or little endian if that is
/// what fits the size of the file, with or without the colours of faces.
/// @param bytes the whole file
/// @param body where the binary counts begin
/// @throws IoError naming the path and byte
Geometry readBinaryOff(const std::filesystem::path& path, std::string_view bytes, std::size_t body,
                       const OffLayout& layout, const Progress& progress);

}  // namespace tufted::io
