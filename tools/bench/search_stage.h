#pragma once

#include "base/point_buffer.h"

namespace tufted::bench {

/// CPU seconds that any method with k nearest neighbours needs at least: for a tree, and a query per point in order, on
/// one thread.
struct SearchSeconds {
  double flann;      ///< KDTreeSingleIndex<L2_Simple<double>>, the fastest of six settings
  double nanoflann;  ///< KDTreeSingleIndexAdaptor, leaves of 10 points
};

/// Measures them. FLANN reuses one result set, and has leaves of 10, 15 or 30 points, with or without a reordered copy
/// of the points: the first call for a size of cloud tries all six settings, later ones repeat the fastest.
/// @param points in Morton order
SearchSeconds searchSeconds(const PointsView& points, int k);

}  // namespace tufted::bench
