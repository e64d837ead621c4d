#pragma once

#include <cstdint>
#include <cstring>

namespace tufted {

/// Two doubles that are worked on together, by every processor with the same bits as one after the other. For loops
/// that the compiler leaves scalar.
using Pair = double __attribute__((vector_size(16)));
/// What comparing pairs gives: 0 or -1.
using PairCounts = std::int64_t __attribute__((vector_size(16)));

inline Pair loadPair(const double* values) {
  Pair result;
  std::memcpy(&result, values, sizeof(Pair));
  return result;
}

inline void storePair(Pair pair, double* values) {
  std::memcpy(values, &pair, sizeof(Pair));
}

inline Pair abs(Pair a) {
  return a < -a ? -a : a;
}

inline Pair least(Pair a, Pair b) {
  return a < b ? a : b;
}

}  // namespace tufted
