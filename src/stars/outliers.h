#pragma once

#include "base/parallel.h"
#include "stars/stars.h"
#include "tufted/report.h"

namespace tufted {

/// Removes the stars of outliers and marks these points in `isolated` (*Outliers* in section 7 of docs/algorithm.md).
///
/// A point is an outlier if most of its k neighbours q are farther from it than their own fit radius, and have it more
/// than 30 degrees off their tangent plane. Where a sparse part of a surface borders on a dense one, its points are
/// beyond these radii too, but lie in the planes. Does nothing with the caller's lists or rings, whose neighbours are
/// not the nearest points.
/// @param cloud,source those that the stars were built from
void isolateOutliers(BuiltStars& built, const RankedCloud& cloud, const NeighborSource& source, const Workers& workers,
                     Report& report);

}  // namespace tufted
