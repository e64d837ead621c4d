#pragma once

// The circular order of Algorithm 1 (Section 4.2; Section 5.4 compares it with others).
#include <Eigen/Geometry>

#include "base/point_buffer.h"
#include "base/pseudo_angle.h"
#include "tufted/types.h"

namespace tufted {

/// The dihedral angle of faces about an edge, which orders them circularly. The basis depends on the edge alone, so
/// copies of one triangle have equal keys.
class DihedralOrder {
 public:
  DihedralOrder(const PointsView& points, int low, int high) : points_(points), low_(low) {
    const Eigen::Vector3d axis = points.row(high) - points.row(low);
    int smallest = 0;
    axis.cwiseAbs().minCoeff(&smallest);
    x_ = axis.cross(Eigen::Vector3d::Unit(smallest));
    y_ = axis.stableNormalized().cross(x_);
  }

  /// Grows with the angle of the face whose third corner is `apex`.
  double key(int apex) const {
    const Eigen::Vector3d d = points_.row(apex) - points_.row(low_);
    return pseudoAngle(d.dot(x_), d.dot(y_));
  }

 private:
  PointsView points_;
  int low_;
  Eigen::Vector3d x_, y_;
};

}  // namespace tufted
