#pragma once

#include <cmath>

namespace tufted {

/// A number in [0, 4] that increases with the angle of (x, y) from the x axis, up to a few 1e-16; 0 for the null
/// vector.
inline double pseudoAngle(double x, double y) {
  const double sum = std::abs(x) + std::abs(y);
  if (sum == 0) return 0;
  return y >= 0 ? 1 - x / sum : 3 + x / sum;
}

}  // namespace tufted
