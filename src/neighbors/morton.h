#pragma once

#include <cstddef>
#include <vector>

#include "base/parallel.h"
#include "base/point_buffer.h"
#include "tufted/types.h"

namespace tufted {

/// The distinct finite points of a cloud along a Morton curve. The position in this order is the point's rank;
/// every tie rule of the pipeline compares ranks, so a permuted cloud gives the permuted result.
struct RankedCloud {
  PointBuffer points;  ///< n x 3, in units of 2^exponent
  PointBuffer move;    ///< n x 3, how points were moved out of noise from where the caller has them; 0 x 3: none was
  Buffer<int> input_index;  ///< n, the caller's index of each rank (of coincident points, the lowest)
  int exponent = 0;

  int size() const { return static_cast<int>(input_index.size()); }
};

/// Scales, sorts and merges. Fills `status` (not_finite, coincident, else active) and `representative` (N each).
RankedCloud rankPoints(const PointsRef& points, std::vector<PointStatus>& status, std::vector<int>& representative,
                       const Workers& workers);
/// rankPoints() on one thread.
RankedCloud rankPoints(const PointsRef& points, std::vector<PointStatus>& status, std::vector<int>& representative);

}  // namespace tufted
