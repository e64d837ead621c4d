#pragma once

#include <cstdint>
#include <span>

#include "base/buffer.h"
#include "base/parallel.h"
#include "base/point_buffer.h"
#include "neighbors/neighbors.h"

namespace tufted {

/// The points around which surfaces are fitted (section 27 of docs/algorithm.md).
struct Centers {
  Buffer<int> rank;     ///< m, ranks of the centres, ascending
  RawBuffer<int> near;  ///< n, index in `rank` of a centre near each point
};

/// The positions of the points with the given ranks.
PointBuffer placesOf(const PointsView& points, std::span<const int> ranks);

/// One point in 32, by a hash of its coordinates, and for each point the nearest of them.
Centers fewCenters(const PointsView& points, const Workers& workers);

/// About one point in three: those that come before their nearest two in the order of d1 / d2, the distances to these,
/// which has no pattern and does not change if the cloud is turned. The centre of another point is found by going to
/// the first of its nearest two, again and again.
/// @param normals n x 3, or 0 x 3: a point comes after none on the other side of a thin part, see keepOwnSide()
/// @param inside n, 1 for points that may be centres; the others get no centre
Centers manyCenters(const PointsView& points, const PointBuffer& normals, const NeighborSearch& search,
                    const Buffer<std::uint8_t>& inside, const Workers& workers);

}  // namespace tufted
