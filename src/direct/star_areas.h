#pragma once

#include "base/buffer.h"
#include "base/parallel.h"
#include "base/point_buffer.h"
#include "stars/stars.h"

namespace tufted {

/// The mixed area (Meyer et al. 2003, Section 3.3) in its own star of each point where the surface ends; between 0 and
/// the area of the star. 0 at other points.
/// @param points n x 3, by rank
/// @returns n areas in units of `points` squared
RawBuffer<double> ownAreas(const Stars& stars, const PointsView& points, const Workers& workers);

}  // namespace tufted
