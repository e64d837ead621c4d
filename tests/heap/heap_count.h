#pragma once

#include <cstdint>

namespace tufted::heap {

/// The memory that this process has requested so far from malloc(), also by operator new.
struct Count {
  std::int64_t blocks = 0;          ///< our own
  std::int64_t foreign_blocks = 0;  ///< those that FLANN and CGAL asked for
};

Count countSoFar();

}  // namespace tufted::heap
