#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <span>

#include "simd/kernels.h"
#include "stars/offsets.h"

namespace tufted {

/// A quadratic through the heights of p and its neighbours over the tangent plane of p.
struct HeightFit {
  std::array<double, 6> coefficient{};  ///< of 1, u, v, u^2, u v, v^2, in units of the fit radius
  double height = 0;                    ///< of the surface over p, along the normal
  double leverage = 1;                  ///< variance of `height` by that of the noise of each point
  /// The variance of the points' distances from the surface: sum of squared residuals / (m - 6). It is infinite where
  /// there is no fit.
  double variance = std::numeric_limits<double>::infinity();
  bool is_valid = false;  ///< false with fewer than 9 points, p included, or where they lie on a conic
};

/// What a fit is made from.
struct HeightMoments {
  HeightSums sums{};      ///< in units of the fit radius
  int count = 0;          ///< points, p included
  double fit_radius = 0;  ///< the radius of the neighbourhood that the heights were taken from
};

/// @param normal unit length
HeightMoments heightMoments(const Offsets& neighbors, const Eigen::Vector3d& normal, double fit_radius);

/// Least squares over {1, u, v, u^2, u v, v^2}, each as if it were alone.
void fitHeights(std::span<const HeightMoments> moments, std::span<HeightFit> fits);

}  // namespace tufted
