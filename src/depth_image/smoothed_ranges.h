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

/// Smoothed inverse depths by pixel, see PixelGrid::depthOf(). A border as wide as any window reaches surrounds the
/// image.
struct SmoothedRanges {
  /// Pixels between the values of the widest fit, that of the second pass.
  static constexpr int widest_stride = 9;
  static constexpr int border = WindowPixels::reach * widest_stride;
  /// Greatest slope of a surface that is smoothed further, in spacings along the sight per pixel: 76 degrees.
  static constexpr double steepest = 4;
  /// Values of one surface differ by at most a slope and this many standard deviations of the noise.
  static constexpr double tolerance = 2;

  int rows = 0, columns = 0;          ///< of the grid
  bool goes_round = false;            ///< as the grid
  std::ptrdiff_t row_step = 0;        ///< in these arrays
  RawBuffer<double> inverse;          ///< NaN where there is no point
  RawBuffer<double> variance;         ///< variance of `inverse`; 0: as measured, or no point
  RawBuffer<double> spacing_squared;  ///< mean squared spacing of neighbouring pixels, in inverse depth

  std::ptrdiff_t at(int row, int column) const { return (row + border) * row_step + column + border; }
  /// The index in these arrays of a pixel of the grid.
  std::ptrdiff_t atPixel(const PixelGrid& grid, std::int64_t pixel) const {
    return at(static_cast<int>(pixel / grid.columns), static_cast<int>(pixel % grid.columns));
  }
  /// The greatest change of a surface per pixel.
  double steepestSlope(std::ptrdiff_t pixel) const { return steepest * std::sqrt(spacing_squared[pixel]); }
  /// Resizes the arrays for an image in which no pixel has a point.
  void clear(const PixelGrid& grid, const Workers& workers);
};

/// Smooths again where the remaining noise is not small compared with the spacing, as on walls far away (step 4 in
/// section 28 of docs/algorithm.md): over pixels 3 apart, then 9, then 5 and 2 for noise of wavelengths in between. On
/// rings the pass with 9 is left out. The remaining noise is known if it is white, and measured otherwise.
/// @param changes_sides see changesSidesFreely()
void smoothFurther(const RangeNoise& noise, bool changes_sides, const Workers& workers, SmoothedRanges& smoothed);

/// Moves each point along its ray to the smoothed depth: sets `displacement`, `place` and `moved`.
void moveAlongRays(const PixelGrid& grid, const PointsView& points, const SmoothedRanges& smoothed,
                   const Workers& workers, SurfaceWindows& windows);

}  // namespace tufted
