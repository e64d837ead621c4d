#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace tufted::io {

/// Why seven numbers are not a valid pose of a sensor, see Geometry::viewpoint; null if they are.
inline const char* poseFault(const std::array<double, 7>& pose) {
  if (!std::all_of(pose.begin(), pose.end(), [](double value) { return std::isfinite(value); }))
    return "a viewpoint that is not finite";
  const bool turns = std::any_of(pose.begin() + 3, pose.end(), [](double value) { return value != 0; });
  return turns ? nullptr : "a viewpoint whose quaternion has the length 0";
}

}  // namespace tufted::io
