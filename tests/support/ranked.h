#pragma once

#include <vector>

#include "neighbors/morton.h"

namespace tufted::support {

/// A cloud in Morton order, for tests that do not use the status of points.
inline RankedCloud ranked(const Points& points) {
  std::vector<PointStatus> status;
  std::vector<int> representative;
  return rankPoints(points, status, representative);
}

}  // namespace tufted::support
