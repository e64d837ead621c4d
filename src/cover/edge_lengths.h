#pragma once

#include <array>
#include <cmath>

#include "base/point_buffer.h"
#include "tufted/types.h"

namespace tufted {

/// Lengths of edges between moved points.
struct EdgeLengths {
  PointsView points;        ///< by vertex
  PointsView displacement;  ///< added to `points`; 0 x 3: nothing

  double operator()(int a, int b) const {
    const auto [x, y, z] = offset(a, b);
    return std::sqrt(x * x + y * y + z * z);
  }

  /// From b to a; the other way round the same bits but for the sign.
  std::array<double, 3> offset(int a, int b) const {
    const double *p = points.data() + 3 * std::ptrdiff_t{a}, *q = points.data() + 3 * std::ptrdiff_t{b};
    double x = p[0] - q[0], y = p[1] - q[1], z = p[2] - q[2];
    if (displacement.rows() > 0) {
      const double *m = displacement.data() + 3 * std::ptrdiff_t{a}, *n = displacement.data() + 3 * std::ptrdiff_t{b};
      x += m[0] - n[0];
      y += m[1] - n[1];
      z += m[2] - n[2];
    }
    return {x, y, z};
  }
};

}  // namespace tufted
