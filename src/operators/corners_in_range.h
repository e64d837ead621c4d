#pragma once

#include <string>

#include "tufted/errors.h"
#include "tufted/types.h"

namespace tufted {

/// @throws InvalidInput for a corner outside of [0, points), naming `function`
inline void requireCornersInRange(const std::string& function, const TrianglesRef& triangles, Eigen::Index points) {
  for (Eigen::Index f = 0; f < triangles.rows(); ++f)
    for (const int corner : triangles.row(f))
      if (corner < 0 || corner >= points)
        throw InvalidInput(function + ": corner " + std::to_string(corner) + " of triangle " + std::to_string(f) +
                           ", must lie in [0, " + std::to_string(points) + ")");
}

}  // namespace tufted
