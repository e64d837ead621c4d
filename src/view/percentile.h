#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace tufted::view {

/// The value below which a share of all values lies, rounded to one of them.
/// @param values at least one; they are reordered
/// @param share in [0, 1]
inline double percentile(std::vector<double>& values, double share) {
  const auto at = values.begin() + std::lround(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace tufted::view
