#pragma once

#include <cmath>

namespace tufted {

/// The greater of two numbers, NaN if one of them is. std::max may drop a NaN, which would hide an unknown error.
inline double greater(double a, double b) {
  return a >= b || std::isnan(a) ? a : b;
}

}  // namespace tufted
