#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace tufted {

/// Negative weights up to this share of the larger diagonal are rounding; an edge that is Delaunay within `flip_below`
/// cannot have more.
constexpr double weight_rounding = 1e-9;

/// Counts the negative weights that are set to 0 in L.
struct ClampedWeights {
  std::int64_t small = 0, large = 0;  ///< counts within and beyond rounding
  double largest = 0;                 ///< largest magnitude over the larger diagonal

  void add(double weight, double larger_diagonal) {
    const double share = larger_diagonal > 0 ? -weight / larger_diagonal : INFINITY;
    ++(share <= weight_rounding ? small : large);
    largest = std::max(largest, share);
  }
};

}  // namespace tufted
