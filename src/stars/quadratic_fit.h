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
  double height = 0;                    ///< height of the surface over p, along the normal
  double leverage = 1;                  ///< variance of `height` over that of the noise of each point
  /// Variance of the residuals, without weights: their sum of squares over m - 6, for m points. Infinite without a fit.
  double variance = std::numeric_limits<double>::infinity();
  /// The least pivot of the normal equations. The noise of the heights has a variance, in units of the fit radius; that
  /// of each coefficient is about this variance over the least pivot.
  double least_pivot = 0;
  bool is_valid = false;  ///< false with fewer than 9 points, p included, or if they lie on a conic
};

/// The sums from which a HeightFit is computed.
struct HeightMoments {
  HeightSums sums{};      ///< in units of the fit radius
  int count = 0;          ///< number of points, p included
  double weight = 0;      ///< sum of their weights
  double fit_radius = 0;  ///< radius of the neighbourhood
};

/// The sums for p and its neighbours.
/// @param normal of the plane, unit length; its coordinates are along tangentOf(normal) and the cross product of both
HeightMoments heightMoments(const Offsets& neighbors, const Eigen::Vector3d& normal, double fit_radius);
/// The sums for curvature, see Kernels::sumWeightedHeights.
HeightMoments weightedMoments(const Offsets& neighbors, const Eigen::Vector3d& normal, double fit_radius);

/// Fits quadratics by least squares, each bit for bit independent of the others.
void fitHeights(std::span<const HeightMoments> moments, std::span<HeightFit> fits);
HeightFit fitHeights(const HeightMoments& moments);

/// The normal of the fitted surface over p.
/// @param normal of the plane over which the heights were measured
Eigen::Vector3d normalOf(const HeightFit& fit, const Eigen::Vector3d& normal);

}  // namespace tufted
