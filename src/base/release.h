#pragma once

#include <vector>

namespace tufted {

/// Gives the memory back, which `v = {}` and clear() keep.
template <class T>
void release(std::vector<T>& values) {
  std::vector<T>().swap(values);
}

}  // namespace tufted
