#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

namespace tufted {

/// A point over a tangent plane: two coordinates in it and the height, over the radius of the window.
struct HeightSample {
  double u, v, height;
};

/// The quadric a + b u + c v + d u^2 / 2 + e u v + f v^2 / 2.
struct HeightFit {
  Eigen::Matrix<double, 6, 1> coefficients;
  Eigen::Vector3d deviation;  ///< standard deviations of d, e, f for independent errors of the heights of 1
  double error;               ///< standard deviation of the heights, from what the fit leaves over
};

/// Fits heights by weighted least squares. The weight (1 - u^2 - v^2)^2 falls to 0 at the radius 1.
/// @return nothing where the samples lie on a line or a conic, so that the fit is not determined
std::optional<HeightFit> fitHeights(std::span<const HeightSample> samples);

}  // namespace tufted
