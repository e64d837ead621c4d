#pragma once

#include "base/buffer.h"
#include "base/stable_sort.h"

namespace tufted {

/// An entry of a row of weights.
struct Entry {
  int column;
  double weight;
};

/// Rows of entries, one after the other.
struct Rows {
  Buffer<int> offset;  ///< one more than rows
  RawBuffer<Entry> entries;
};

/// Sorts entries by column and sums those of equal columns, in the order given, to the front. Returns where they end.
inline Entry* mergeColumns(Entry* first, Entry* last, Buffer<Entry>& scratch) {
  stableSort(first, last, scratch, [](const Entry& a, const Entry& b) { return a.column < b.column; });
  Entry* kept = first;
  for (const Entry* at = first; at != last; ++at) {
    if (kept != first && (kept - 1)->column == at->column)
      (kept - 1)->weight += at->weight;
    else
      *kept++ = *at;
  }
  return kept;
}

}  // namespace tufted
