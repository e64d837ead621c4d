#pragma once

#include <cstddef>

namespace tufted {

/// A limit in bytes as options state it: 0 is half of the machine's memory.
std::size_t memoryLimit(std::size_t option);

}  // namespace tufted
