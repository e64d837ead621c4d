#pragma once

#include <array>
#include <cmath>

#include "base/point_buffer.h"
#include "tufted/types.h"

namespace tufted {

/// Lengths of edges between points.
struct EdgeLengths {
  PointsView points;  ///< by vertex

  double operator()(int a, int b) const {
    const auto [x, y, z] = offset(a, b);
    return std::sqrt(x * x + y * y + z * z);
  }

  /// From b to a; the other way round the same bits but for the sign.
  std::array<double, 3> offset(int a, int b) const {
    const double *p = points.data() + 3 * std::ptrdiff_t{a}, *q = points.data() + 3 * std::ptrdiff_t{b};
    return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
  }
};

}  // namespace tufted
