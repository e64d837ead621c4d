#pragma once

#include <cstddef>
#include <filesystem>

namespace tufted {

/// Bytes that this process may take: the least of the machine's memory, of what is available now (MemAvailable), and of
/// the limits of its control groups (version 1 or 2).
/// @param root of the file system, for tests
std::size_t availableMemory(const std::filesystem::path& root = "/");

}  // namespace tufted
