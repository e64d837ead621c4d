#pragma once

#include "base/point_buffer.h"

namespace tufted::bench {

/// CPU seconds that FLANN takes for what any method with k nearest neighbours needs at least: a tree, and a query per
/// point in order, on one thread. It reuses one result set, and has leaves of 10, 15 or 30 points, with or without a
/// reordered copy of the points: the first call for a size of cloud tries all six settings, later ones repeat the
/// fastest.
/// @param points in Morton order
double searchSeconds(const PointsView& points, int k);

}  // namespace tufted::bench
