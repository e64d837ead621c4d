#pragma once

#include <Eigen/Core>
#include <vector>

#include "tufted/view/scene.h"

namespace tufted::view {

/// Whether values of a kind are shown as their logarithms to base 10.
inline bool isLogarithmic(FieldKind kind) {
  return kind == FieldKind::positive;
}

/// The numbers by which points are coloured: a column, its logarithms, or lengths of rows. NaN where there is none.
Eigen::VectorXd shownValues(const SceneField& field, int column);

/// The values at the ends of a colour map.
struct ValueRange {
  double low = 0, high = 0;
};

/// What can be chosen for it, for values of a kind.
struct ValueRanges {
  ValueRange usual;   ///< of most values: outliers have the colour of an end
  ValueRange all;     ///< from the least to the greatest
  ValueRange middle;  ///< from the 1st to the 99th percentile
};

/// @param values those of shownValues(). Lengths begin at 0, and values around 0 have the same range on both sides.
ValueRanges rangesOf(FieldKind kind, const Eigen::Ref<const Eigen::VectorXd>& values);

}  // namespace tufted::view
