#pragma once

#include <cstddef>

#include "tufted/memory.h"

namespace tufted {

/// The limit in bytes for a value of SolverOptions::memory_limit: 0 means half of the available memory.
std::size_t memoryLimit(std::size_t option);

}  // namespace tufted
