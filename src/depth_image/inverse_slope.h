#pragma once

#include <algorithm>
#include <cmath>

#include "depth_image/window_pixels.h"

namespace tufted {

/// The change of the inverse range per row and per column at a pixel, see commonSlope(). On a plane it is the same at
/// every pixel, however low the angle at which the plane is seen.
struct InverseSlope {
  double down = 0, right = 0;
};

/// Bounds of a change of the inverse range.
struct Rise {
  double least, most;
};

/// Bounds of the change along a surface over a step from one pixel to another: by the slopes of both, or anything in
/// between if the surface bends.
inline Rise riseBetween(const InverseSlope& a, const InverseSlope& b, const PixelStep& step) {
  const auto [least_down, most_down] = std::minmax({step.row * a.down, step.row * b.down});
  const auto [least_right, most_right] = std::minmax({step.column * a.right, step.column * b.right});
  return {least_down + least_right, most_down + most_right};
}

/// The smaller of the changes before and after a pixel; 0 if their signs differ, one is unknown (NaN), or it exceeds
/// `most`. Beside a jump this is the slope of the surface, because the jump is larger.
inline double commonSlope(double before, double after, double most) {
  if (!(before * after > 0)) return 0;
  const double slope = std::abs(before) < std::abs(after) ? before : after;
  return std::abs(slope) <= most ? slope : 0;
}

}  // namespace tufted
