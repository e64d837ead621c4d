#pragma once

#include "base/parallel.h"
#include "stars/stars.h"
#include "tufted/report.h"

namespace tufted {

/// Takes the stars of outliers away, however many there are, and marks them in `isolated`.
///
/// An outlier sees a surface that does not see it: most of its k neighbours q lie further from it than the neighbours
/// of q from q, and have it more than 30 degrees off their own tangent plane. Where a sparse part of a surface borders
/// on a dense one, its points are not seen either, but lie in the plane. Nothing is done where the neighbours are not
/// the nearest points: with the caller's lists or the structure of a scan.
/// @param cloud,source what the stars were built from
void isolateOutliers(BuiltStars& built, const RankedCloud& cloud, const NeighborSource& source, const Workers& workers,
                     Report& report);

}  // namespace tufted
