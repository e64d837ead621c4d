#pragma once

#include <algorithm>
#include <vector>

namespace tufted {

/// Sorts values, and keeps one of those that are equal.
template <class Value>
void sortUnique(std::vector<Value>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace tufted
