#pragma once

#include <vector>

#include "view/projection.h"

namespace tufted::view {

/// The discs that points are drawn as.
struct Discs {
  /// N, in the coordinates of the points: discs so wide that, together with their neighbours', they leave no hole in
  /// the surface; at most a share of the scene, and not much more than others have, so that a point far from all others
  /// is a dot. Discs of points without a value in the first field, NaN, are no larger than the median: mostly these lie
  /// on no surface, and would hide what lies behind them.
  std::vector<float> radii;
  /// The finite points along a curve on which neighbours are near each other, so that memory is when they are drawn.
  std::vector<int> order;
};

Discs discsOf(const Scene& scene, const NormalizedPoints& points, int threads);

}  // namespace tufted::view
