#pragma once

#include <cstdint>

namespace tufted::heap {

/// What this process has asked of malloc(), and operator new by way of it, so far.
struct Count {
  std::int64_t blocks = 0;          ///< our own
  std::int64_t foreign_blocks = 0;  ///< those that FLANN and CGAL asked for
};

Count countSoFar();

}  // namespace tufted::heap
