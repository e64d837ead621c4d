#pragma once

#include <cstdint>

#include "base/buffer.h"
#include "base/parallel.h"
#include "base/stable_sort.h"

namespace tufted {

/// An entry of a row of weights.
struct Entry {
  int column;
  double weight;
};

/// Rows of entries, stored one after the other.
struct Rows {
  Buffer<int> offset;  ///< starts in `entries`, and the end
  RawBuffer<Entry> entries;
};

/// Sorts entries by column and merges those of equal columns, summing weights in the given order. Returns the end of
/// the merged ones, which come first.
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

/// mergeColumns() in every row. Returns the new sizes of the rows; their starts do not change.
inline Buffer<int> mergeRows(Rows& rows, const Workers& workers) {
  Buffer<int> size(rows.offset.size() - 1);
  workers.forBlocks("assemble", std::ssize(size), cheap_block, [&](std::int64_t begin, std::int64_t end, int) {
    Buffer<Entry> scratch;
    for (std::int64_t p = begin; p < end; ++p) {
      Entry* const first = rows.entries.data() + rows.offset[p];
      Entry* const last = rows.entries.data() + rows.offset[p + 1];
      size[p] = static_cast<int>(mergeColumns(first, last, scratch) - first);
    }
  });
  return size;
}

}  // namespace tufted
