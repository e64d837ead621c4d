#pragma once

#include <optional>

#include "base/parallel.h"
#include "base/point_buffer.h"
#include "neighbors/scan/ranked_scan.h"

namespace tufted {

/// A scan whose rows are those of an image that goes round.
struct RingImage {
  RankedScan scan;  ///< positions are columns
  int columns = 0;  ///< of a whole turn, of which some may be empty
};

/// The rings of a spinning scanner as the rows of an image: azimuths become columns.
/// @param scan rows are rings, positions azimuths in [0, 2 pi)
/// @returns nothing where windows of pixels would not do: the rings lie far apart, there are too few of them, or the
/// points of a ring do not follow each other in even steps with few gaps
std::optional<RingImage> columnsOfRings(RankedScan scan, const PointsView& points, const Workers& workers);

}  // namespace tufted
