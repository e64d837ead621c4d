#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace tufted::view {

/// The value that a share of all values is below, the nearest of them; `values` are put into another order.
/// @param values at least one
inline double percentile(std::vector<double>& values, double share) {
  const auto at = values.begin() + std::lround(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace tufted::view
