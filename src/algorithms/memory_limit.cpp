#include "algorithms/memory_limit.h"

#include <unistd.h>

#include <cstdint>

namespace tufted {

std::size_t memoryLimit(std::size_t option) {
  if (option > 0) return option;
  const long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
  return pages > 0 && size > 0 ? static_cast<std::size_t>(pages) / 2 * static_cast<std::size_t>(size) : SIZE_MAX;
}

}  // namespace tufted
