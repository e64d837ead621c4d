#pragma once

#include <Eigen/Core>
#include <span>

#include "base/point_buffer.h"
#include "neighbors/neighbors.h"
#include "simd/kernels.h"
#include "tufted/types.h"

namespace tufted {

/// Principal axes of a neighbourhood (section 3 of docs/algorithm.md).
struct PrincipalAxes {
  Eigen::Vector3d normal;    ///< eigenvector of the smallest eigenvalue
  Eigen::Vector3d variance;  ///< eigenvalues, ascending, in units of `extent` squared
  double extent = 1;         ///< a power of two near the neighbourhood's extent
};

/// Covariance of p and its neighbours about their centroid, from coordinates relative to p, so that the distance from
/// the origin does not matter.
struct Covariance {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;  ///< in units of `extent` squared
  double extent = 0;                                      ///< see PrincipalAxes; 0 if all are at one position
};

/// The covariances of p and its first ends[0], ends[1], ... neighbours, each bit for bit as if computed by itself.
/// @param ends ascending, at most most_sets
/// @param size extent of the neighbourhood, within a few powers of two; 0 if unknown
void findCovariances(const Offsets& neighbors, double size, std::span<const int> ends,
                     std::span<Covariance> covariances);
/// The covariance of p and all its neighbours.
Covariance covarianceOf(const Offsets& neighbors, double size = 0);

/// The principal axes of each covariance, bit for bit independent of the others.
void principalAxes(std::span<const Covariance> covariances, std::span<PrincipalAxes> axes);
PrincipalAxes principalAxes(const Offsets& neighbors);
PrincipalAxes principalAxes(const PointsView& points, int p, std::span<const Neighbor> neighbors);

/// Whether points lie on one line, as on one scan line: the second variance is below a tenth of the largest.
bool liesOnOneLine(const PrincipalAxes& axes);

/// Whether points are as thick as wide, as in volumes and on cables that they reach around: the smallest variance
/// exceeds half of the second, and they do not lie on one line.
bool areThick(const PrincipalAxes& axes);

/// A unit vector perpendicular to the unit vector `normal`, a function of `normal` only.
Eigen::Vector3d tangentOf(const Eigen::Vector3d& normal);

}  // namespace tufted
