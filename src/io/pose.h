#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace tufted::io {

/// Checks a pose of the sensor, see Geometry::viewpoint.
/// @return why it is not valid; null if it is
inline const char* poseFault(const std::array<double, 7>& pose) {
  if (!std::all_of(pose.begin(), pose.end(), [](double value) { return std::isfinite(value); }))
    return "a viewpoint that is not finite";
  const bool turns = std::any_of(pose.begin() + 3, pose.end(), [](double value) { return value != 0; });
  return turns ? nullptr : "a viewpoint whose quaternion has the length 0";
}

}  // namespace tufted::io
