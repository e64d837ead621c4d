#pragma once

#include <vector>

#include "neighbors/morton.h"

namespace tufted::support {

/// A cloud in the order of a build, for tests that do not ask which points take part.
inline RankedCloud ranked(const Points& points) {
  std::vector<PointStatus> status;
  std::vector<int> representative;
  return rankPoints(points, status, representative);
}

}  // namespace tufted::support
