#pragma once

#include "tufted/types.h"

namespace tufted::bench {

/// Points as PCL's MovingLeastSquares moves them.
/// @param radius of the fits, in the points' unit
/// @param order of the polynomials
Points movedByLeastSquares(const Points& points, double radius, int order);

}  // namespace tufted::bench
