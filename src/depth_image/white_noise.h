#pragma once

#include "depth_image/pixel_grid.h"
#include "depth_image/smoothed_ranges.h"

namespace tufted {

/// Whether neighbouring pixels lie on the same side of the surface as often as noise that differs freely from pixel to
/// pixel has them. Noise of real cameras goes on from pixel to pixel, and the steps of a coarse depth change sides in a
/// regular way. Only where fits left little is looked at, so that the shape of the surface matters little.
/// @param smoothed once
/// @returns false where no two neighbours were smoothed
bool changesSidesFreely(const PixelGrid& grid, const PointsView& points, const SmoothedRanges& smoothed,
                        const RangeNoise& noise, const Workers& workers);

}  // namespace tufted
