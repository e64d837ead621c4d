#pragma once

#include <vector>

#include "view/projection.h"

namespace tufted::view {

/// The discs as which points are drawn.
struct Discs {
  /// N radii in normalised coordinates, so wide that neighbouring discs leave no hole in the surface, but at most a
  /// share of the scene and a few times the median, so that a point far from all others is a dot. Discs of points whose
  /// value in the first field is NaN are at most as large as the median: mostly these lie on no surface, and would hide
  /// what is behind them.
  std::vector<float> radii;
  /// The finite points in Morton order, so that points drawn one after another are near in memory.
  std::vector<int> order;
};

Discs discsOf(const Scene& scene, const NormalizedPoints& points, int threads);

}  // namespace tufted::view
