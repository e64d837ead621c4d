#pragma once

#include <Eigen/Core>

#include "base/buffer.h"
#include "stars/delaunay_star.h"

namespace tufted {

/// The direction of the middle of the gap of an open star, not normalised; zero if the star has no link.
Eigen::Vector2d middleOfGap(const DelaunayStar& star);

/// Whether the points leave a gap of pi or more around a direction, so that their star is open; exact if true. If
/// points are added to an open star, any gap that remains contains the middle of the former one.
bool leaveGap(const Buffer<PlanarPoint>& points, const Eigen::Vector2d& middle);

}  // namespace tufted
