#pragma once

#include <algorithm>
#include <cstddef>

#include "base/buffer.h"

namespace tufted {

/// Element floor(share * size) in ascending order. Reorders `values`.
/// @param values not empty
/// @param share in [0, 1)
inline double quantileOf(Buffer<double>& values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// The median of the values. Of an even number it is the upper one of the two in the middle, and of no values it is 0.
inline double medianOf(Buffer<double> values) {
  return values.empty() ? 0 : quantileOf(values, 0.5);
}

}  // namespace tufted
