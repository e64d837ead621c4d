#pragma once

#include <cmath>
#include <string>

#include "base/number_text.h"
#include "tufted/errors.h"

namespace tufted {

/// @param time_step in squared distances of neighbours
/// @throws InvalidInput where heat would go less than a hundredth of these, or where rounding decides: next to the heat
/// of such a time the areas of points are lost
inline void checkHeatTime(const std::string& function, double time_step) {
  // Bounds of the time, in squared distances of neighbours. Below, heat would go a hundredth of the way to the next
  // point and be rounding there; above, masses are lost beside t L.
  constexpr double shortest = 1e-4, longest = 1e12;
  if (!(time_step > 0 && std::isfinite(time_step)))
    throw InvalidInput(function + ": time_step = " + numberText(time_step) + ", must be finite and above 0");
  if (time_step >= shortest && time_step <= longest) return;
  throw InvalidInput(function + ": time_step = " + numberText(time_step) + ", must lie in [" + numberText(shortest) +
                     ", " + numberText(longest) + "]");
}

}  // namespace tufted
