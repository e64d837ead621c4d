#pragma once

#include <Eigen/Core>
#include <span>

#include "base/point_buffer.h"
#include "cloud/kernels.h"
#include "cloud/neighbors.h"
#include "tufted/types.h"

namespace tufted {

/// A quadratic through the heights of p and its neighbours over the tangent plane of p.
struct HeightFit {
  double height = 0;      ///< of the surface over p, along the normal
  double variance = 0;    ///< of the points around the surface: sum of squared residuals / (m - 6)
  bool is_valid = false;  ///< false with fewer than 9 points, p included, or where they lie on a conic
};

/// Least squares over {1, u, v, u^2, u v, v^2}.
/// @param normal unit length
/// @param reach radius of the neighbourhood, which is the unit of the fit
/// @param taken the offsets of just these neighbours, or null
HeightFit fitHeights(const PointsView& points, int p, std::span<const Neighbor> neighbors,
                     const Eigen::Vector3d& normal, double reach, const Offsets* taken = nullptr);

/// Whether a neighbourhood is noise around a surface rather than curved: the residuals of the fit are more than a fifth
/// of the smallest variance. An exact plane is not.
/// @param variance the smallest eigenvalue of the neighbourhood's covariance
bool isNoisy(const HeightFit& fit, double variance, double reach);

}  // namespace tufted
