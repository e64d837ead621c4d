#pragma once

#include "base/parallel.h"
#include "base/point_buffer.h"
#include "denoise/noise_level.h"
#include "neighbors/neighbor_source.h"

namespace tufted {

/// How the points of a cloud move onto the surface.
struct SurfaceMoves {
  PointBuffer move;  ///< n x 3, exactly 0 where a point stays
  NoiseLevel noise;  ///< empty with too few points
};

/// Finds the surface within the noise, and how each point gets onto it.
/// @param source by search in `points`, for Windows::first_base neighbours
SurfaceMoves surfaceMoves(const PointsView& points, const NeighborSource& source, const Workers& workers);

}  // namespace tufted
