#pragma once

#include <algorithm>
#include <iterator>

#include "base/buffer.h"

namespace tufted {

/// Of an even number of values the upper one of the two in the middle; 0 of none.
inline double medianOf(Buffer<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace tufted
