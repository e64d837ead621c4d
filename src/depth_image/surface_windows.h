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

/// What a depth image shows around each point, by rank.
struct SurfaceWindows {
  /// n, the pixels of the window that hold points of the surface around p, see WindowPixels. They are those that steps
  /// from pixel to pixel lead to, farther from p each, none of which goes along the line of sight. Pixels without a
  /// point are stepped over, but where a pixel beside them knows better.
  Buffer<std::uint64_t> around;
  RawBuffer<double> range;     ///< n, from the sensor; not set where a point has no pixel
  Buffer<InverseSlope> slope;  ///< n, as range; 0 entries where the image does not go round
  PointBuffer displacement;    ///< n x 3, along the ray, onto the surface; 0 x 3 without smoothing
  PointBuffer place;           ///< n x 3, where that leads to; 0 x 3 without smoothing
  std::int64_t cut = 0;        ///< points in windows that a jump of the surface leaves out
  std::int64_t moved = 0;      ///< points whose displacement is not 0
};

/// @param noise see rangeNoise()
SurfaceWindows findSurfaceWindows(const PixelGrid& grid, const PointsView& points, const RangeNoise& noise,
                                  bool smooths, const Workers& workers);

/// Whether a surface goes from one point to another near it in the image: the step between them does not go along the
/// line of sight by more than noise. A step along the diagonal of pixels may go along the sight no more than one along
/// a row, or it would find a way around each corner of a jump.
struct JumpTest {
  /// Squared tangent of 85 degrees: a steeper step is a jump. With 64 or 25 more pixels are cut off and no triangle
  /// gets better.
  static constexpr double steepest = 143;
  /// The squared tangent of 80 degrees. Rings of a spinning scanner lie so far apart that a jump between two may look
  /// no steeper than a surface; a steeper step is one of a surface where the slope goes on, see InverseSlope.
  static constexpr double steepest_of_rings = 32;
  /// Steps of up to so many standard deviations of the noise are no jump. From 3 to 6 results are nearly the same; 3
  /// cuts walls with noise of a quarter of a pixel.
  static constexpr double deviations = 5;

  static JumpTest of(const RangeNoise& noise) { return {deviations * noise}; }

  /// @param step in the image, not zero
  static constexpr double steepestOf(const PixelStep& step, double along_rows = steepest) {
    const double row = step.row, column = step.column, ring = step.ring();
    return along_rows * (ring * ring) / (row * row + column * column);
  }

  /// @param most the square of the tangent, see steepestOf()
  bool joins(double squared_step, double range_a, double range_b, double most = steepest) const {
    const double along = std::abs(range_a - range_b);
    const double more = along - tolerance.of_inverse * range_a * range_b - tolerance.of_depth;
    // Without branches, so that many are tested at once.
    return (static_cast<int>(more <= 0) | static_cast<int>(more * more <= most * (squared_step - along * along))) != 0;
  }

  /// Whether two pixels are joined as above, where along the surface the inverse range may change by `rise` from a to
  /// b.
  bool joins(double squared_step, double range_a, double range_b, double most, const Rise& rise) const {
    const double product = range_a * range_b, along = range_a - range_b;
    const double beyond = std::max({0.0, along - rise.most * product, rise.least * product - along});
    const double more = beyond - tolerance.of_inverse * product - tolerance.of_depth;
    return more <= 0 || more * more <= most * (squared_step - along * along);
  }

  RangeNoise tolerance;
};

}  // namespace tufted
