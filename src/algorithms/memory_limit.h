#pragma once

#include <cstddef>
#include <filesystem>

namespace tufted {

/// Bytes that this process may still take: the least of what the system has available (MemAvailable) and what its
/// control groups, of version 1 or 2, allow it in all.
/// @param root of the file system, for tests; if it states no memory, the machine's memory counts
std::size_t availableMemory(const std::filesystem::path& root = "/");

/// A limit in bytes as options state it: 0 is half of the available memory.
std::size_t memoryLimit(std::size_t option);

}  // namespace tufted
