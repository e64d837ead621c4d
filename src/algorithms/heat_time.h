#pragma once

#include <cmath>
#include <string>

#include "base/number_text.h"
#include "tufted/errors.h"

namespace tufted {

/// Checks the time step of the heat equation.
/// @param time_step in mean squared edges
/// @throws InvalidInput outside of [1e-4, 1e12]
inline void checkHeatTime(const std::string& function, double time_step) {
  // Below, heat would spread a hundredth of the way to the next point and be rounding there; above, masses are lost
  // beside t L.
  constexpr double shortest = 1e-4, longest = 1e12;
  if (!(time_step > 0 && std::isfinite(time_step)))
    throw InvalidInput(function + ": time_step = " + numberText(time_step) + ", must be finite and above 0");
  if (time_step >= shortest && time_step <= longest) return;
  throw InvalidInput(function + ": time_step = " + numberText(time_step) + ", must lie in [" + numberText(shortest) +
                     ", " + numberText(longest) + "]");
}

}  // namespace tufted
