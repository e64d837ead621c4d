#pragma once

#include <algorithm>
#include <utility>

#include "base/buffer.h"

namespace tufted {

/// Sorts [first, last) as std::stable_sort() does, but allocates nothing itself.
/// @param scratch memory for the merges, overwritten if there are more than 32 values
template <class T, class Less>
void stableSort(T* first, T* last, Buffer<T>& scratch, const Less& less) {
  constexpr std::ptrdiff_t run = 32;  // length of the runs that are sorted by insertion
  const std::ptrdiff_t size = last - first;
  for (std::ptrdiff_t begin = 0; begin < size; begin += run) {
    T* const start = first + begin;
    for (T* at = start; at < first + std::min(begin + run, size); ++at) {
      const T moved = *at;
      T* place = at;
      for (; place != start && less(moved, *(place - 1)); --place) *place = *(place - 1);
      *place = moved;
    }
  }
  if (size <= run) return;
  scratch.assign(first, last);
  T *from = first, *to = scratch.data();
  for (std::ptrdiff_t width = run; width < size; width *= 2) {
    for (std::ptrdiff_t begin = 0; begin < size; begin += 2 * width) {
      T* const middle = from + std::min(begin + width, size);
      std::merge(from + begin, middle, middle, from + std::min(begin + 2 * width, size), to + begin, less);
    }
    std::swap(from, to);
  }
  if (from != first) std::copy(from, from + size, first);
}

}  // namespace tufted
