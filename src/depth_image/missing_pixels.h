#pragma once

#include "base/parallel.h"
#include "depth_image/pixel_grid.h"
#include "depth_image/smoothed_ranges.h"

namespace tufted {

/// Sets the inverse depth of missing pixels between two pixels of one surface to their mean (step 4 in section 28 of
/// docs/algorithm.md). This moves no point, but makes windows whole: with one pixel in twenty missing at random only
/// one window in twelve would be, too few to measure the remaining noise and to fit quadratics. Does nothing on rings,
/// which are too far apart.
void fillMissingPixels(const PixelGrid& grid, const RangeNoise& noise, const Workers& workers,
                       SmoothedRanges& smoothed);

}  // namespace tufted
