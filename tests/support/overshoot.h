#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "algorithms/connected.h"
#include "tufted/interpolation.h"

namespace tufted::support {

/// By how much values leave the range of their column's pins, relative to that range; infinite if a value on a
/// component with a pin is NaN.
inline double overshoot(const Laplacian& laplacian, const Eigen::MatrixXd& u, const Pins& pins) {
  const Components components = findComponents(laplacian);
  std::vector<bool> reached(components.count, false);
  for (const int point : pins.points) {
    const int component = components.of[laplacian.representative[point]];
    if (component >= 0) reached[component] = true;
  }
  double worst = 0;
  for (Eigen::Index c = 0; c < u.cols(); ++c) {
    const double low = pins.values.col(c).minCoeff(), high = pins.values.col(c).maxCoeff();
    for (Eigen::Index i = 0; i < u.rows(); ++i) {
      const int component = components.of[laplacian.representative[i]];
      const double value = u(i, c), outside = std::max((low - value) / (high - low), (value - high) / (high - low));
      if (!std::isnan(value))
        worst = std::max(worst, outside);
      else if (component >= 0 && reached[component])
        return HUGE_VAL;
    }
  }
  return worst;
}

}  // namespace tufted::support
