#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace tufted {

/// Points over a tangent plane, in any one unit: two coordinates in it and the height.
struct HeightSamples {
  std::vector<double> u, v, height;

  void clear() {
    u.clear();
    v.clear();
    height.clear();
  }
  void add(double u_value, double v_value, double height_value) {
    u.push_back(u_value);
    v.push_back(v_value);
    height.push_back(height_value);
  }
};

/// The surface h = a + b u + c v + d U^2 / 2 + e U V + f V^2 / 2, all over the radius of a window, where (U, V) points
/// as (u, v) does and is as long as (u, v, h): U^2 + V^2 = u^2 + v^2 + h^2. So a sphere is such a surface however wide
/// the window, where heights would need ever higher powers of u and v, and other surfaces are nearly so.
///
/// Where a is 0, the curvatures at the origin are the eigenvalues of -(d, e; e, f) / sqrt(1 + b^2 + c^2), positive
/// where the surface falls on all sides.
struct SurfaceFit {
  Eigen::Matrix<double, 6, 1> coefficients;
  Eigen::Vector3d deviation;  ///< standard deviations of d, e, f for independent errors of the heights of 1
  double freedom;             ///< that independent errors of the heights of 1 would leave over, weighted, squared
};

/// Fits heights by weighted least squares. The weight (1 - u^2 - v^2 - h^2)^2 falls to 0 at the radius.
/// @return nothing where the samples lie on a line or a conic, so that the fit is not determined
std::optional<SurfaceFit> fitHeights(const HeightSamples& samples, double radius);

/// Standard deviation of the heights over the radius, from what the fit leaves over; infinite where it leaves no
/// freedom.
double errorOf(const SurfaceFit& fit, const HeightSamples& samples, double radius);

}  // namespace tufted
