#pragma once

#include <filesystem>
#include <string>

namespace tufted::io {

/// The bytes of a regular file that is not empty.
/// @throws IoError if it is missing, not a regular file (a directory, a pipe), empty, or cannot be read
std::string readBytes(const std::filesystem::path& path);

}  // namespace tufted::io
