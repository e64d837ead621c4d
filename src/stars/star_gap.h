#pragma once

#include <Eigen/Core>

#include "base/buffer.h"
#include "stars/delaunay_star.h"

namespace tufted {

/// The direction in the middle of the gap of an open star, of any length; zero where the star has no link.
Eigen::Vector2d middleOfGap(const DelaunayStar& star);

/// Whether the points leave a gap of pi or more around a direction, so that their star is open. Exact where it says so.
/// Where more points stand around an open star, a gap that is left holds the middle of the one before.
bool leaveGap(const Buffer<PlanarPoint>& points, const Eigen::Vector2d& middle);

}  // namespace tufted
