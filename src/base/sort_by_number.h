#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace tufted {

/// Sorts many values whose order begins with a small number, faster than std::sort(): first by this number, then each
/// group by itself.
/// @param numberOf numberOf(value) lies in [0, numbers)
/// @param less the whole order, in which values with smaller numbers come first
template <class Value, class NumberOf, class Less>
void sortByNumber(std::vector<Value>& values, std::size_t numbers, const NumberOf& numberOf, const Less& less) {
  std::vector<std::size_t> end(numbers + 1, 0);  // of each group
  for (const Value& value : values) ++end[numberOf(value) + 1];
  std::partial_sum(end.begin(), end.end(), end.begin());
  std::vector<Value> grouped(values.size());
  for (const Value& value : values) grouped[end[numberOf(value)]++] = value;
  for (std::size_t i = 0, begin = 0; i < numbers; begin = end[i++])
    std::sort(grouped.begin() + static_cast<std::ptrdiff_t>(begin),
              grouped.begin() + static_cast<std::ptrdiff_t>(end[i]), less);
  values.swap(grouped);
}

}  // namespace tufted
