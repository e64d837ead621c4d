#pragma once

#include "base/buffer.h"
#include "base/parallel.h"
#include "base/point_buffer.h"
#include "stars/stars.h"

namespace tufted {

/// The mixed area (Meyer et al. 2003, Section 3.3) of each point in its own star where the surface ends at the point;
/// never negative, never more than the star's triangles. 0 elsewhere.
/// @param points n x 3, by rank
/// @returns n areas in units of `points` squared
RawBuffer<double> ownAreas(const Stars& stars, const PointsView& points, const Workers& workers);

}  // namespace tufted
