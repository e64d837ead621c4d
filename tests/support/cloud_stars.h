#pragma once

#include <utility>
#include <vector>

#include "neighbors/neighbor_source.h"
#include "stars/surface_stars.h"
#include "tufted/options.h"

namespace tufted::support {

/// A cloud in Morton order, and its stars.
struct CloudStars {
  RankedCloud cloud;
  SurfaceStars built;
};

/// Computes the stars of a cloud as a build does.
inline CloudStars starsOf(const Points& points, const CloudOptions& options = {}) {
  std::vector<PointStatus> status;
  std::vector<int> representative;
  CloudStars result{rankPoints(points, status, representative), {}};
  const Progress silent;
  const Workers workers(2, silent);
  Report report;
  const NeighborSource source = neighborSource(options, result.cloud, status, representative, workers, report);
  result.built = surfaceStars(result.cloud, source, options, workers, report);
  return result;
}

}  // namespace tufted::support
