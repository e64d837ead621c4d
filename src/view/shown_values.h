#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "tufted/view/scene.h"

namespace tufted::view {

/// Whether values of a kind are shown as their logarithms to base 10.
inline bool isLogarithmic(FieldKind kind) {
  return kind == FieldKind::positive;
}

/// The values by which points are coloured: a column, its logarithms, or the lengths of rows; NaN if there is none.
Eigen::VectorXd shownValues(const SceneField& field, int column);

/// The points from which distances, or coordinates of a logarithmic map, are measured: those whose value is exactly 0.
/// The list is empty if they are so many that they cover a curve or a part of the surface.
/// @param values as from shownValues()
std::vector<int> sourcesOf(FieldKind kind, const Eigen::Ref<const Eigen::VectorXd>& values);

/// The values at the ends of a colour map.
struct ValueRange {
  double low = 0, high = 0;
};

/// Ranges of the colour map that can be chosen.
struct ValueRanges {
  ValueRange usual;   ///< from the least to the greatest value except outliers
  ValueRange all;     ///< from the least to the greatest value
  ValueRange middle;  ///< from the 1st to the 99th percentile
};

/// Finds these ranges. Those of lengths begin at 0; those of diverging values are symmetric about 0.
/// @param values as from shownValues()
ValueRanges rangesOf(FieldKind kind, const Eigen::Ref<const Eigen::VectorXd>& values);

/// The value below which a share of all values lies, rounded to one of them.
/// @param values at least one; they are reordered
/// @param share in [0, 1]
inline double percentile(std::vector<double>& values, double share) {
  const auto at = values.begin() + std::lround(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace tufted::view
