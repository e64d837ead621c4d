#pragma once

#include <filesystem>
#include <string>

namespace tufted::io {

/// Reads all bytes of a file.
/// @throws IoError if it is missing, empty, not a regular file (a directory, a pipe), or cannot be read
std::string readBytes(const std::filesystem::path& path);

}  // namespace tufted::io
