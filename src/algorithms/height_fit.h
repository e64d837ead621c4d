#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace tufted {

/// Points over a tangent plane: two coordinates in it and the height, all in one unit.
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

/// The surface h = a + b u + c v + d U^2 / 2 + e U V + f V^2 / 2, lengths in units of a window's radius, where (U, V)
/// has the direction of (u, v) and the length of (u, v, h). A sphere is exactly such a surface in a window of any
/// width.
///
/// If a = 0, the curvatures at the origin are the eigenvalues of -(d, e; e, f) / sqrt(1 + b^2 + c^2), positive where
/// the surface falls on all sides.
struct SurfaceFit {
  Eigen::Matrix<double, 6, 1> coefficients;
  Eigen::Vector3d deviation;  ///< standard deviations of d, e, f for independent height errors of 1
  double freedom;             ///< expected weighted sum of squared residuals for such errors
};

/// Fits heights by weighted least squares. The weight (1 - u^2 - v^2 - h^2)^2 falls to 0 at the radius.
/// @param radius of the window, > 0, in the unit of the samples
/// @return nullopt if the samples lie on a line or a conic
std::optional<SurfaceFit> fitHeights(const HeightSamples& samples, double radius);

/// Standard deviation of the height errors over the radius, from the residuals of a fit; infinite if `freedom` is not
/// positive.
double errorOf(const SurfaceFit& fit, const HeightSamples& samples, double radius);

}  // namespace tufted
