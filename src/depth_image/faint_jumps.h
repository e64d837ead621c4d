#pragma once

#include "depth_image/pixel_grid.h"
#include "depth_image/smoothed_ranges.h"
#include "depth_image/surface_windows.h"

namespace tufted {

/// Follows jumps to where they run out: where a box stands on the floor, its jump becomes less than what noise does to
/// one pixel. Along the line on which pixels were refused, planes over both sides still show it. Windows on either
/// side of such a line leave out the other, and what is smoothed by them is smoothed again. Nothing changes where
/// noise is harmless, nor in images that go round.
/// @param noise see rangeNoise()
/// @param windows of all pixels, complete but for displacements
/// @param smoothed by these windows
void cutFaintJumps(const PixelGrid& grid, const PointsView& points, const RangeNoise& noise, SurfaceWindows& windows,
                   SmoothedRanges& smoothed);

}  // namespace tufted
