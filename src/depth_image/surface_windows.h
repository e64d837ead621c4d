#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/buffer.h"
#include "base/parallel.h"
#include "base/point_buffer.h"
#include "depth_image/inverse_slope.h"
#include "depth_image/pixel_grid.h"
#include "depth_image/range_noise.h"
#include "depth_image/window_pixels.h"

namespace tufted {

/// The window of each point, by rank (section 28 of docs/algorithm.md, steps 3 and 4).
struct SurfaceWindows {
  /// n, sets of pixels with points of the surface around p, see WindowPixels: those that are joined with p (JumpTest)
  /// and reached by steps from ring to ring between joined pixels. A missing pixel is stepped over, unless the step to
  /// the next pixel from one beside it is a jump.
  Buffer<std::uint64_t> around;
  RawBuffer<double> range;     ///< n, distance from the sensor; not set without a pixel
  Buffer<InverseSlope> slope;  ///< n, like `range`; empty if the image does not go round
  PointBuffer displacement;    ///< n x 3, move along the ray onto the surface; 0 x 3 without smoothing
  PointBuffer place;           ///< n x 3, moved points; 0 x 3 without smoothing
  std::int64_t cut = 0;        ///< points within reach of windows that a jump leaves out
  std::int64_t moved = 0;      ///< number of points whose displacement is not 0
};

/// Finds the windows and, with `smooths`, moves the points.
SurfaceWindows findSurfaceWindows(const PixelGrid& grid, const PointsView& points, const RangeNoise& noise,
                                  bool smooths, const Workers& workers);

/// Whether two nearby pixels are joined: the step between their points does not go along the line of sight by more than
/// noise explains. A diagonal step may go along the sight no farther than one along a row, or it would lead around the
/// corners of a jump.
struct JumpTest {
  /// Squared tangent of 85 degrees: a steeper step is a jump. With 64 or 25 more pixels are cut off and no triangle
  /// gets better.
  static constexpr double steepest = 143;
  /// Squared tangent of 80 degrees. Rings are so far apart that a jump between two may look no steeper than a surface;
  /// a steeper step counts as surface if the slope continues, see InverseSlope.
  static constexpr double steepest_of_rings = 32;
  /// A step of up to this many standard deviations of the noise is no jump. From 3 to 6 results are nearly the same; 3
  /// cuts walls with noise of a quarter of a pixel.
  static constexpr double deviations = 5;

  static JumpTest of(const RangeNoise& noise) { return {deviations * noise}; }

  /// The squared tangent of the steepest step without a jump.
  /// @param step in the image, not zero
  static constexpr double steepestOf(const PixelStep& step, double along_rows = steepest) {
    const double row = step.row, column = step.column, ring = step.ring();
    return along_rows * (ring * ring) / (row * row + column * column);
  }

  /// @param most squared tangent, see steepestOf()
  bool joins(double squared_step, double range_a, double range_b, double most = steepest) const {
    const double along = std::abs(range_a - range_b);
    const double more = along - tolerance.of_inverse * range_a * range_b - tolerance.of_depth;
    // Without branches, so that compilers can test many at once.
    return (static_cast<int>(more <= 0) | static_cast<int>(more * more <= most * (squared_step - along * along))) != 0;
  }

  /// Tests whether two pixels are joined on a surface along which the inverse range may change by `rise` from a to b.
  bool joins(double squared_step, double range_a, double range_b, double most, const Rise& rise) const {
    const double product = range_a * range_b, along = range_a - range_b;
    const double beyond = std::max({0.0, along - rise.most * product, rise.least * product - along});
    const double more = beyond - tolerance.of_inverse * product - tolerance.of_depth;
    return more <= 0 || more * more <= most * (squared_step - along * along);
  }

  RangeNoise tolerance;
};

}  // namespace tufted
