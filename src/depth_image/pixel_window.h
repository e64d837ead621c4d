#pragma once

#include <cstddef>
#include <cstdint>

#include "base/buffer.h"
#include "base/point_buffer.h"
#include "depth_image/pixel_grid.h"
#include "depth_image/surface_windows.h"
#include "depth_image/window_pixels.h"
#include "neighbors/neighbors.h"
#include "stars/offsets.h"

namespace tufted {

/// A depth image, its surface windows, and its points as measured and as moved. Borrowed.
struct DepthImage {
  const PixelGrid& grid;
  PointsView points;  ///< as measured
  PointsView moved;   ///< as moved onto the surface
  const SurfaceWindows& windows;
  JumpTest test;

  bool isOneSurface(int a, int b) const { return isOneSurface(a, b, steepest()); }
  bool isOneSurface(int a, int b, const PixelStep& step) const {
    return isOneSurface(a, b, JumpTest::steepestOf(step, steepest()));
  }

 private:
  double steepest() const { return grid.goes_round ? JumpTest::steepest_of_rings : JumpTest::steepest; }

  bool isOneSurface(int a, int b, double most) const {
    const double *const p = points.data() + 3 * std::ptrdiff_t{a}, *const q = points.data() + 3 * std::ptrdiff_t{b};
    const double x = p[0] - q[0], y = p[1] - q[1], z = p[2] - q[2];
    const double squared_step = x * x + y * y + z * z, range_a = windows.range[a], range_b = windows.range[b];
    if (test.joins(squared_step, range_a, range_b, most)) return true;
    if (!grid.goes_round) return false;
    const Rise rise = riseBetween(windows.slope[a], windows.slope[b], grid.stepBetween(a, b));
    return test.joins(squared_step, range_a, range_b, most, rise);
  }
};

/// The points of the window around one point, ring by ring.
class PixelWindow {
 public:
  /// Takes the points of the first rings of SurfaceWindows::around.
  void take(const DepthImage& image, int p, int rings);
  /// Takes the points of a larger window, found by the same rule.
  void widen(const DepthImage& image, int p, int rings);

  int rings() const { return rings_; }
  int count() const { return static_cast<int>(neighbors_.size()); }
  /// Ring by ring, not by distance; distances are between moved points.
  const Buffer<Neighbor>& neighbors() const { return neighbors_; }
  const PixelStep& step(int i) const { return steps_[i]; }
  /// Offsets from p to the points, between moved points.
  Offsets offsets() const { return offsets_.view(); }
  /// Squared distance of the nearest point of the last ring; infinite if that is empty.
  double nearestInLastRing() const;
  /// Squared distance of the nearest point in the first and last row; infinite if these are empty.
  double nearestInLastRows() const;

 private:
  void measure(const DepthImage& image, int p);

  Buffer<Neighbor> neighbors_;
  Buffer<PixelStep> steps_;
  int rings_ = 0, last_ring_ = 0;  ///< number of rings, and index where the last one begins
  OffsetBuffer offsets_;
  Buffer<std::uint8_t> reached_;
};

}  // namespace tufted
