#pragma once

#include <Eigen/Core>

#include "base/buffer.h"
#include "base/parallel.h"
#include "neighbors/morton.h"
#include "stars/stars.h"
#include "tufted/types.h"

namespace tufted {

/// Why the surface ends at each point, by rank (section 8 of docs/algorithm.md): none where `stars.ends` is 0, lost
/// where no triangle is left.
/// @param viewpoint the sensor, in the caller's unit; null: gaps are only tested along normals
/// @param built gets `boundary_reach`
Buffer<Boundary> findBoundary(BuiltStars& built, const RankedCloud& cloud, const NeighborSource& source,
                              const Eigen::Vector3d* viewpoint, const Workers& workers);

}  // namespace tufted
