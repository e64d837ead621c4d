#pragma once

#include <Eigen/Core>

namespace tufted {

/// A closed ball.
struct Ball {
  Eigen::Vector3d center;  ///< in the caller's unit
  double radius;           ///< in the caller's unit, >= 0
};

}  // namespace tufted
