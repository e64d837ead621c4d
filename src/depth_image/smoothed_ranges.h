#pragma once

#include <cmath>
#include <cstddef>

#include "base/buffer.h"
#include "base/parallel.h"
#include "base/point_buffer.h"
#include "depth_image/pixel_grid.h"
#include "depth_image/range_fit.h"
#include "depth_image/range_noise.h"
#include "depth_image/surface_windows.h"

namespace tufted {

/// Inverse depths without noise, pixel by pixel; see PixelGrid::depthOf(). A border goes around the image, as wide as
/// any window reaches.
struct SmoothedRanges {
  /// Pixels between the values of the widest window, that of the second pass.
  static constexpr int widest_stride = 9;
  static constexpr int border = WindowPixels::reach * widest_stride;
  /// Pixels along the sight for one across, 76 degrees; steeper surfaces are not smoothed again.
  static constexpr double steepest = 4;
  /// Values of one surface differ by at most so many standard deviations of the noise and a slope.
  static constexpr double tolerance = 2;

  int rows = 0, columns = 0;          ///< of the grid
  bool goes_round = false;            ///< as the grid
  std::ptrdiff_t row_step = 0;        ///< in these arrays
  RawBuffer<double> inverse;          ///< NaN where there is no point
  RawBuffer<double> variance;         ///< of it; 0: as measured, and where there is no point
  RawBuffer<double> spacing_squared;  ///< of neighbouring pixels, in inverse depth

  std::ptrdiff_t at(int row, int column) const { return (row + border) * row_step + column + border; }
  /// Where a pixel of the grid is.
  std::ptrdiff_t atPixel(const PixelGrid& grid, std::int64_t pixel) const {
    return at(static_cast<int>(pixel / grid.columns), static_cast<int>(pixel % grid.columns));
  }
  /// The largest change of a surface with each pixel.
  double steepestSlope(std::ptrdiff_t pixel) const { return steepest * std::sqrt(spacing_squared[pixel]); }
  /// Makes room for an image, in which no pixel holds a point.
  void clear(const PixelGrid& grid, const Workers& workers);
};

/// Where what is left of the noise is not small against the spacing of the pixels, as on walls far away, smooths again
/// over pixels that are 3 apart, then 9: over 19 pixels, then 55, and more by what was smoothed before. Two more
/// passes, 5 and 2 apart, take what noise lies between those distances. The rings of a scanner get all but the second.
/// What noise the values still have is known where it is white, and else told by the image.
/// @param changes_sides see changesSidesFreely()
void smoothFurther(const RangeNoise& noise, bool changes_sides, const Workers& workers, SmoothedRanges& smoothed);

/// Moves each point along its ray to the smoothed depth: sets displacements, places and how many move.
void moveAlongRays(const PixelGrid& grid, const PointsView& points, const SmoothedRanges& smoothed,
                   const Workers& workers, SurfaceWindows& windows);

}  // namespace tufted
