#pragma once

#include <vector>

#include "base/buffer.h"
#include "base/parallel.h"
#include "base/stage_clock.h"
#include "neighbors/morton.h"
#include "stars/surface_stars.h"
#include "tufted/options.h"
#include "tufted/report.h"

namespace tufted {

/// Result of steps 2 to 8 of docs/algorithm.md.
struct CloudSurface {
  SurfaceStars built;         ///< the stars (Section 5.7)
  Buffer<Boundary> boundary;  ///< n, why the surface ends at each point
  /// n, standard deviation of the noise around each moved point, in units of the ranked points, 0 at others; or 0
  /// values if no point moved.
  RawBuffer<double> noise;
};

/// Finds the stars of all points, without outliers and filtered triangles, and where the surface ends: by the pixels of
/// a depth image, or by neighbours from a tree, rings or the caller's lists. Records every stage but that of the
/// boundary, which the caller finishes.
/// @param cloud its points are moved onto the surface if the options say so
/// @param viewpoint the sensor, in the caller's unit, or null
CloudSurface findSurface(RankedCloud& cloud, const CloudOptions& options, const Eigen::Vector3d* viewpoint,
                         const std::vector<PointStatus>& status, const std::vector<int>& representative,
                         const Workers& workers, StageClock& clock, Report& report);

}  // namespace tufted
