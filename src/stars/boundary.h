#pragma once

#include <Eigen/Core>

#include "base/buffer.h"
#include "base/parallel.h"
#include "neighbors/morton.h"
#include "stars/stars.h"
#include "tufted/types.h"

namespace tufted {

/// Why the surface ends at each point, by rank; none where `stars.ends` is 0, lost where no triangle is left.
/// @param viewpoint in the caller's unit; null: what lies beyond a point's gaps is judged along its normal alone
Buffer<Boundary> findBoundary(const BuiltStars& built, const RankedCloud& cloud, const NeighborSource& source,
                              const Eigen::Vector3d* viewpoint, const Workers& workers);

}  // namespace tufted
