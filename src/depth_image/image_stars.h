#pragma once

#include <cstddef>
#include <vector>

#include "base/parallel.h"
#include "base/stage_clock.h"
#include "depth_image/pixel_window.h"
#include "neighbors/morton.h"
#include "stars/stars.h"
#include "tufted/options.h"
#include "tufted/report.h"

namespace tufted {

/// A depth image whose surface is known pixel by pixel.
struct SurfaceImage {
  PixelGrid grid;
  SurfaceWindows windows;
  double noise = 0;  ///< see inverseRangeNoise()

  std::size_t bytes() const {
    return grid.bytes() + bytesOf(windows.around) + bytesOf(windows.range) + windows.displacement.bytes();
  }
  /// @param points of the cloud, borrowed
  DepthImage view(const PointsView& points) const { return {grid, points, windows, JumpTest(noise)}; }
};

/// Finds the surface in the windows of all pixels, and moves points onto it if the options say so.
SurfaceImage surfaceImage(const ScanStructure& structure, const RankedCloud& cloud, const CloudOptions& options,
                          const std::vector<PointStatus>& status, const std::vector<int>& representative,
                          const Workers& workers, Report& report);

/// The Delaunay stars of all points among the points in the windows of their pixels. Counts grown,
/// open and dropped ones; the caller books the cost.
/// @param normals the caller's, by rank, zero where unusable; 0 x 3: none
BuiltStars buildImageStars(const DepthImage& image, const PointBuffer& normals, const CloudOptions& options,
                           const Workers& workers, Report& report);

}  // namespace tufted
