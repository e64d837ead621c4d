#pragma once

#include <algorithm>
#include <iterator>

#include "base/buffer.h"

namespace tufted {

/// The median of the values. Of an even number it is the upper one of the two in the middle, and of no values it is 0.
inline double medianOf(Buffer<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace tufted
