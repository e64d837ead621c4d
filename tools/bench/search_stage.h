#pragma once

#include "base/point_buffer.h"

namespace tufted::bench {

/// What any method based on k nearest neighbours pays at least: a tree over the points and one query per point, in
/// their order, on one thread, in seconds of the processor.
struct SearchSeconds {
  double flann;      ///< KDTreeSingleIndex<L2_Simple<double>>, the fastest of six settings
  double nanoflann;  ///< KDTreeSingleIndexAdaptor, leaves of 10 points
};

/// FLANN with one reused result set per cloud; leaves of 10, 15 and 30 points, with and without a reordered copy of the
/// points. The first call for a size of cloud tries all six, later ones repeat the fastest.
/// @param points in Morton order
SearchSeconds searchSeconds(const PointsView& points, int k);

}  // namespace tufted::bench
