#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

namespace tufted {

/// A point over a tangent plane: two coordinates in it and the height, over the radius of the window.
struct HeightSample {
  double u, v, height;
};

/// The surface h = a + b u + c v + d U^2 / 2 + e U V + f V^2 / 2, where (U, V) points as (u, v) does and is as long as
/// (u, v, h): U^2 + V^2 = u^2 + v^2 + h^2. So a sphere is such a surface however wide the window, where heights would
/// need ever higher powers of u and v, and other surfaces are nearly so.
///
/// Where a is 0, the curvatures at the origin are the eigenvalues of -(d, e; e, f) / sqrt(1 + b^2 + c^2), positive
/// where the surface falls on all sides.
struct SurfaceFit {
  Eigen::Matrix<double, 6, 1> coefficients;
  Eigen::Vector3d deviation;  ///< standard deviations of d, e, f for independent errors of the heights of 1
  double error;               ///< standard deviation of the heights, from what the fit leaves over
};

/// Fits heights by weighted least squares. The weight (1 - u^2 - v^2 - h^2)^2 falls to 0 at the radius 1.
/// @return nothing where the samples lie on a line or a conic, so that the fit is not determined
std::optional<SurfaceFit> fitHeights(std::span<const HeightSample> samples);

}  // namespace tufted
