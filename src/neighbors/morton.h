#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/parallel.h"
#include "base/point_buffer.h"
#include "base/power_of_two.h"
#include "base/scaling.h"
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

/// The grid along whose Morton curve points are sorted.
class MortonGrid {
 public:
  static constexpr int axis_bits = 21;  ///< bits of a code per axis: three axes fill 63
  /// A median spread has 2^16 cells per axis, so the grid covers 32 spreads. Points outside fall into its border.
  static constexpr int spread_bits = 16;

  explicit MortonGrid(const Scaling& scaling);

  /// Scaled coordinates without -0, so that equal numbers have equal bits.
  Eigen::Array3d scaled(const Eigen::RowVector3d& point) const;
  /// The place of scaled coordinates on the curve. Points outside of the grid fall into its border.
  std::uint64_t codeOf(const Eigen::Array3d& scaled) const;

 private:
  PowerOfTwo to_scaled_;
  Eigen::Array3d corner_;
};

/// Scales points, sorts them along the Morton curve and merges equal ones (section 1 of docs/algorithm.md).
/// @param points N x 3
/// @param[out] status N; not_finite, coincident, else active
/// @param[out] representative N, see Laplacian::representative
/// @param whole scaling of a cloud of which these are a part, all usable: they are ordered as there. Null: their own
/// scaling
RankedCloud rankPoints(const PointsRef& points, std::vector<PointStatus>& status, std::vector<int>& representative,
                       const Workers& workers, const Scaling* whole = nullptr);
/// rankPoints() on one thread.
RankedCloud rankPoints(const PointsRef& points, std::vector<PointStatus>& status, std::vector<int>& representative);

}  // namespace tufted
