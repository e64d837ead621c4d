#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace tufted::view {

/// The value that a share of all values is below, the nearest of them; `values` are put into another order.
/// @param values at least one
inline double percentile(std::vector<double>& values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace tufted::view
