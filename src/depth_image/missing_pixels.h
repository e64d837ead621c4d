#pragma once

#include "base/parallel.h"
#include "depth_image/pixel_grid.h"
#include "depth_image/smoothed_ranges.h"

namespace tufted {

/// Sets the inverse depth of pixels without a point that lie between two of one surface: to the mean of those. No point
/// moves by this, but the windows around are whole. Where one pixel in twenty is missing at random, one window in
/// twelve would be whole otherwise, too few to tell what noise is left and to fit quadratics. Rings are left as they
/// are, as the next one is far away.
void fillMissingPixels(const PixelGrid& grid, const RangeNoise& noise, const Workers& workers,
                       SmoothedRanges& smoothed);

}  // namespace tufted
