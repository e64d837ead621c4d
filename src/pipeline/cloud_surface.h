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

/// What the steps before the cover find.
struct CloudSurface {
  SurfaceStars built;         ///< the local Delaunay triangulation of each point (Section 5.7)
  Buffer<Boundary> boundary;  ///< n, why the surface ends at each point
  /// n, the standard deviation of the noise around each point that was moved out of it, in units of the ranked points;
  /// 0 at others. 0 entries where none was moved.
  RawBuffer<double> noise;
};

/// The stars of all points, without outliers and triangles that the neighbours refuse, and where the surface ends: by
/// the pixels of a depth image, or by the neighbours that a tree, the rings of a scanner or the caller know. Books
/// every stage but that of the boundary, which it leaves running.
/// @param cloud whose points are moved onto the surface where there is noise, if the options say so
/// @param viewpoint where the sensor stood, in the caller's unit, or null
CloudSurface findSurface(RankedCloud& cloud, const CloudOptions& options, const Eigen::Vector3d* viewpoint,
                         const std::vector<PointStatus>& status, const std::vector<int>& representative,
                         const Workers& workers, StageClock& clock, Report& report);

}  // namespace tufted
