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
  PointBuffer points;       ///< n x 3, in units of 2^exponent
  PointBuffer move;         ///< n x 3, how far denoising moved each point; 0 x 3: nothing moved
  Buffer<int> input_index;  ///< n, the caller's index of each rank (the lowest one of coincident points)
  int exponent = 0;

  int size() const { return static_cast<int>(input_index.size()); }
};

/// Scales points, sorts them along the Morton curve and merges equal ones (section 1 of docs/algorithm.md).
/// @param points N x 3
/// @param[out] status N; not_finite, coincident, else active
/// @param[out] representative N, see Laplacian::representative
RankedCloud rankPoints(const PointsRef& points, std::vector<PointStatus>& status, std::vector<int>& representative,
                       const Workers& workers);
/// rankPoints() on one thread.
RankedCloud rankPoints(const PointsRef& points, std::vector<PointStatus>& status, std::vector<int>& representative);

}  // namespace tufted
