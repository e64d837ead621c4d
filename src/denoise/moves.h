#pragma once

#include <cstdint>

#include "base/parallel.h"
#include "base/point_buffer.h"
#include "neighbors/neighbors.h"

namespace tufted {

/// The moves of the points of a cloud onto the surface.
struct SurfaceMoves {
  PointBuffer move;  ///< n x 3, exactly 0 where a point stays
  /// n, variance of the noise around each point that moves, in length^2; undefined at others
  RawBuffer<double> variance;
  Buffer<std::uint8_t> outlier;  ///< n, 1 at points that stay because they are far off the surface of their neighbours
  std::int64_t no_surface = 0;   ///< points that stay because their neighbours form a curve or fill a volume

  /// The number of points that move.
  std::int64_t count() const;
};

/// Finds the surface within the noise and the move of each point onto it (section 27 of docs/algorithm.md).
/// @param points n x 3, those of `search`
/// @param normals n x 3, of unit length or 0, or 0 x 3 if not known: their signs tell the sides of thin parts apart
SurfaceMoves surfaceMoves(const PointsView& points, const PointBuffer& normals, const NeighborSearch& search,
                          const Workers& workers);

}  // namespace tufted
