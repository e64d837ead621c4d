#pragma once

#include <Eigen/Dense>

namespace tufted::bench {

/// One step of point-to-plane registration (Chen and Medioni 1992), by least squares.
class PlaneSteps {
 public:
  /// @param height signed distance of the point from a plane
  void add(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, double height, double weight = 1) {
    Eigen::Matrix<double, 6, 1> base;
    base << point.cross(normal), normal;
    left_ += weight * base * base.transpose();
    right_ -= weight * height * base;
  }
  /// The motion that brings the points nearest to their planes.
  Eigen::Isometry3d motion() const {
    const Eigen::Matrix<double, 6, 1> step = left_.ldlt().solve(right_);
    const double angle = step.head<3>().norm();
    const Eigen::Vector3d axis = angle > 0 ? Eigen::Vector3d(step.head<3>() / angle) : Eigen::Vector3d::UnitX();
    return Eigen::Translation3d(step.tail<3>()) * Eigen::AngleAxisd(angle, axis);
  }

 private:
  Eigen::Matrix<double, 6, 6> left_ = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> right_ = Eigen::Matrix<double, 6, 1>::Zero();
};

}  // namespace tufted::bench
