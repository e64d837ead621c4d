#pragma once

#include <optional>

#include "base/parallel.h"
#include "base/point_buffer.h"
#include "neighbors/scan/ranked_scan.h"

namespace tufted {

/// A scan as an image that goes round.
struct RingImage {
  RankedScan scan;  ///< positions are columns
  int columns = 0;  ///< number of columns of a whole turn; some may be empty
};

/// Makes rings the rows of an image, and azimuths columns (*Rings* in section 28 of docs/algorithm.md).
/// @param scan rows are numbers of rings, positions are azimuths in [0, 2 pi)
/// @returns nothing if windows of pixels would not do: the rings are too far apart or too few, or the points of a ring
/// do not follow each other in even steps with few gaps
std::optional<RingImage> columnsOfRings(RankedScan scan, const PointsView& points, const Workers& workers);

}  // namespace tufted
