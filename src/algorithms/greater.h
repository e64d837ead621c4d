#pragma once

#include <cmath>

namespace tufted {

/// The greater of two numbers, NaN if one of them is. std::max may drop a NaN, so that an unknown error would look like
/// none.
inline double greater(double a, double b) {
  return a >= b || std::isnan(a) ? a : b;
}

}  // namespace tufted
