#pragma once

#include "depth_image/pixel_grid.h"
#include "depth_image/smoothed_ranges.h"

namespace tufted {

/// Whether neighbouring pixels lie on the same side of the surface as often as with white noise. Noise of real cameras
/// is similar in neighbouring pixels, and the steps of a coarse depth change sides regularly. Only pixels with small
/// residuals are tested, so that the shape of the surface matters little.
/// @param smoothed smoothed once
/// @returns false if no two neighbours were smoothed
bool changesSidesFreely(const PixelGrid& grid, const PointsView& points, const SmoothedRanges& smoothed,
                        const RangeNoise& noise, const Workers& workers);

}  // namespace tufted
