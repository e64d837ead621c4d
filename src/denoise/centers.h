#pragma once

#include <cstdint>
#include <span>

#include "base/buffer.h"
#include "base/parallel.h"
#include "base/point_buffer.h"
#include "neighbors/neighbors.h"

namespace tufted {

/// The points of a cloud that surfaces are fitted around, and which of them stands for each point.
struct Centers {
  Buffer<int> rank;     ///< m, ascending
  RawBuffer<int> near;  ///< n, the number of a centre close to each point
};

/// Where the points of some ranks are.
PointBuffer placesOf(const PointsView& points, std::span<const int> ranks);

/// One point in 32, by its place alone, and the nearest of them for each point.
Centers fewCenters(const PointsView& points, const Workers& workers);

/// One point in three: those that come before their nearest two in the order of how much nearer the first of these is
/// than the second, which has no pattern and turns with the cloud. For each point the one that is reached by going to
/// the neighbour that comes first.
/// @param inside n, which points may be chosen; the others have none
Centers manyCenters(const PointsView& points, const NeighborSearch& search, const Buffer<std::uint8_t>& inside,
                    const Workers& workers);

}  // namespace tufted
