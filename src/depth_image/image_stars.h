#pragma once

#include <cstddef>
#include <cstdint>

#include "base/parallel.h"
#include "base/stage_clock.h"
#include "depth_image/pixel_window.h"
#include "neighbors/scan/ranked_scan.h"
#include "stars/stars.h"
#include "tufted/options.h"
#include "tufted/report.h"

namespace tufted {

/// A depth image with the surface around each pixel.
struct SurfaceImage {
  PixelGrid grid;
  SurfaceWindows windows;
  RangeNoise noise;           ///< see rangeNoise()
  std::int64_t unplaced = 0;  ///< points without a pixel

  /// Standard deviation of the noise along the ray of a point that has a pixel.
  double noiseOf(int p, const PointsView& points) const {
    return noise.atRange(windows.range[p], grid.depthOf(points.row(p)));
  }
  std::size_t bytes() const {
    return grid.bytes() + bytesOf(windows.around) + bytesOf(windows.range) + windows.displacement.bytes() +
           windows.place.bytes();
  }
  /// @param points of the cloud, borrowed
  DepthImage view(const PointsView& points) const {
    return {grid, points, windows.place.rows() > 0 ? PointsView(windows.place) : points, windows, JumpTest::of(noise)};
  }
};

/// Finds axis, noise and windows of an image (steps 2 to 4 in section 28 of docs/algorithm.md).
/// @param smooths whether points are moved onto the surface
SurfaceImage surfaceImage(PixelGrid grid, const PointsView& points, bool smooths, const Workers& workers);

/// The Delaunay stars of all points among the points in their windows (steps 5 and 6). Counts grown, open and dropped
/// ones; the caller records the cost.
/// @param normals the caller's, by rank, zero if unusable; 0 x 3 without any
BuiltStars buildImageStars(const DepthImage& image, const PointBuffer& normals, const CloudOptions& options,
                           const Workers& workers, Report& report);

}  // namespace tufted
