#pragma once

#include <algorithm>
#include <iterator>
#include <vector>

namespace tufted {

/// An entry of a row of weights.
struct Entry {
  int column;
  double weight;
};

/// Rows of entries, one after the other.
struct Rows {
  std::vector<int> offset;  ///< one more than rows
  std::vector<Entry> entries;
};

/// Sorts entries by column and sums those of equal columns, in the order given, to the front. Returns where they end.
template <class Iterator>
Iterator mergeColumns(Iterator first, Iterator last) {
  std::stable_sort(first, last, [](const Entry& a, const Entry& b) { return a.column < b.column; });
  Iterator kept = first;
  for (Iterator at = first; at != last; ++at) {
    if (kept != first && std::prev(kept)->column == at->column)
      std::prev(kept)->weight += at->weight;
    else
      *kept++ = *at;
  }
  return kept;
}

}  // namespace tufted
