#pragma once

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

}  // namespace tufted
