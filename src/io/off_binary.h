#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

#include "io/off_layout.h"
#include "tufted/io/read.h"

namespace tufted::io {

/// Reads the binary form of OFF, made of 32-bit integers and floats. The standard's is big endian with colours of
/// faces; little endian or missing colours are recognised by the size of the file.
/// @param bytes the whole file
/// @param body byte at which the binary counts begin
/// @throws IoError naming the path and byte
Geometry readBinaryOff(const std::filesystem::path& path, std::string_view bytes, std::size_t body,
                       const OffLayout& layout, const Progress& progress);

}  // namespace tufted::io
