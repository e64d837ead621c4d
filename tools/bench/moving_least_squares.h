#pragma once

#include "tufted/types.h"

namespace tufted::bench {

/// Moves points by PCL's MovingLeastSquares.
/// @param radius radius of the fits, in the points' unit
/// @param order degree of the polynomials
Points movedByLeastSquares(const Points& points, double radius, int order);

}  // namespace tufted::bench
