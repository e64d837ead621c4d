#pragma once

#include <Eigen/Core>
#include <string>

#include "tufted/laplacian.h"

namespace tufted {

/// Coordinates relative to the centre of the active points' bounding box, in units of a power of two near their extent,
/// so that neither the caller's unit nor the distance from the origin matters.
class ShapeFrame {
 public:
  /// @param function named in errors
  /// @throws InvalidInput for arrays of the wrong size, or positions of active points that are not finite
  ShapeFrame(const std::string& function, const Laplacian& laplacian);

  /// @param positions N x 3, in the caller's unit
  /// @return N x 3
  Eigen::MatrixXd toFrame(const Eigen::Ref<const Eigen::MatrixXd>& positions) const;
  Eigen::RowVector3d toCaller(const Eigen::RowVector3d& position) const;
  /// Converts a length to the caller's unit.
  double toCaller(double length) const;
  /// Converts an area to the caller's unit squared.
  double areaToCaller(double area) const;
  double areaToFrame(double area) const;
  /// The largest side of the bounding box of the active points, in [1/2, 1) of the frame's unit; 0: one place, or none.
  double extent() const { return extent_; }

 private:
  Eigen::RowVector3d origin_ = Eigen::RowVector3d::Zero();
  int exponent_ = 0;
  double extent_ = 0;
};

}  // namespace tufted
