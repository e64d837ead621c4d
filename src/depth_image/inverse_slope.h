#pragma once

#include <algorithm>
#include <cmath>

#include "depth_image/window_pixels.h"

namespace tufted {

/// How the inverse range changes with a row and with a column at a pixel, where it does so alike on both sides; else 0.
/// On a plane it is the same from pixel to pixel, however low the angle at which the plane is seen.
struct InverseSlope {
  double down = 0, right = 0;
};

/// Bounds of a change.
struct Rise {
  double least, most;
};

/// How the inverse range may change along a surface with a step from one pixel to another: by the slopes of the two, or
/// by anything between them where the surface bends.
inline Rise riseBetween(const InverseSlope& a, const InverseSlope& b, const PixelStep& step) {
  const auto [least_down, most_down] = std::minmax({step.row * a.down, step.row * b.down});
  const auto [least_right, most_right] = std::minmax({step.column * a.right, step.column * b.right});
  return {least_down + least_right, most_down + most_right};
}

/// The smaller of the changes before and after a pixel if they have one sign; 0 where they have not, one is not known
/// (NaN), or it is too large. At a jump it is that of the surface, as the jump is larger.
inline double commonSlope(double before, double after, double most) {
  if (!(before * after > 0)) return 0;
  const double slope = std::abs(before) < std::abs(after) ? before : after;
  return std::abs(slope) <= most ? slope : 0;
}

}  // namespace tufted
