#pragma once

#include <filesystem>
#include <string>

namespace tufted::io {

/// The size of a regular file in bytes.
/// @throws IoError if it is missing, not a regular file (a directory, a pipe) or empty
std::size_t fileSize(const std::filesystem::path& path);

/// The bytes of a regular file that is not empty.
/// @throws IoError as fileSize does, or if it cannot be read
std::string readBytes(const std::filesystem::path& path);

}  // namespace tufted::io
