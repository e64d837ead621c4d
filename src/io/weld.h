#pragma once

#include <vector>

#include "tufted/io/read.h"

namespace tufted::io {

/// Which points share a position.
struct Welding {
  std::vector<int> vertex;  ///< N: the new number of each point
  std::vector<int> kept;    ///< the point that each new number stands for, the first of its position
};

/// Finds points of equal position; those that are not finite stay apart.
Welding findEqual(const Points& points);

}  // namespace tufted::io
