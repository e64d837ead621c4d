#pragma once

#include <cmath>

namespace tufted {

/// The greater of two, NaN where one is: std::max may drop that, and what is not known would look like no error.
inline double greater(double a, double b) {
  return a >= b || std::isnan(a) ? a : b;
}

}  // namespace tufted
