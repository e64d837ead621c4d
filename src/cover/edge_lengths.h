#pragma once

#include <array>
#include <cmath>

#include "base/point_buffer.h"
#include "tufted/types.h"

namespace tufted {

/// Euclidean lengths of edges between points.
struct EdgeLengths {
  PointsView points;  ///< by vertex

  double operator()(int a, int b) const {
    const auto [x, y, z] = offset(a, b);
    return std::sqrt(x * x + y * y + z * z);
  }

  /// The vector from b to a; offset(b, a) is the same with all signs changed, bit for bit.
  std::array<double, 3> offset(int a, int b) const {
    const double *p = points.data() + 3 * std::ptrdiff_t{a}, *q = points.data() + 3 * std::ptrdiff_t{b};
    return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
  }
};

}  // namespace tufted
