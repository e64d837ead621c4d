#pragma once

#include "depth_image/pixel_grid.h"
#include "depth_image/surface_windows.h"

namespace tufted {

/// Whether a surface without noise goes on from one point to another though the step between them is steep: it is not
/// much longer along the sight than the same step before it. So it is up to the rim of a body that curves away from the
/// camera, where the range goes like a root; a jump is longer than that. False for pixels more than 3 apart.
/// @param a, b ranks of points that have pixels
bool goesOnToRim(const PixelGrid& grid, const PointsView& points, const JumpTest& test, int a, int b);

}  // namespace tufted
