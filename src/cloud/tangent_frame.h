#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <span>

#include "base/point_buffer.h"
#include "cloud/kernels.h"
#include "cloud/neighbors.h"
#include "tufted/types.h"

namespace tufted {

/// Principal axes of a neighbourhood.
struct PrincipalAxes {
  Eigen::Vector3d normal;    ///< eigenvector of the smallest eigenvalue
  Eigen::Vector3d variance;  ///< eigenvalues, ascending, in units of `extent` squared
  double extent = 1;         ///< a power of two near the neighbourhood's extent
};

/// Positions relative to p of at most Offsets::most points.
void takeOffsets(const PointsView& points, int p, std::span<const Neighbor> neighbors, Offsets& offsets);

/// Calls visit() for the neighbours of p, as many at a time as `offsets` holds.
template <class Visit>
void forEachPart(const PointsView& points, int p, std::span<const Neighbor> neighbors, Offsets& offsets,
                 const Visit& visit) {
  for (; !neighbors.empty(); neighbors = neighbors.subspan(offsets.count)) {
    takeOffsets(points, p, neighbors.first(std::min<std::size_t>(Offsets::most, neighbors.size())), offsets);
    visit();
  }
}

/// Covariance of p and its neighbours about their centroid, from coordinates relative to p, so that the distance from
/// the origin does not matter.
struct Covariance {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;  ///< in units of `extent` squared
  double extent = 0;                                      ///< see PrincipalAxes; 0 where all are at one place
};

/// @param[out] offsets of the neighbours, if they are at most Offsets::most
Covariance covarianceOf(const PointsView& points, int p, std::span<const Neighbor> neighbors, Offsets& offsets);

/// Of each covariance; those of one do not depend on the others.
void principalAxes(std::span<const Covariance> covariances, std::span<PrincipalAxes> axes);
PrincipalAxes principalAxes(const PointsView& points, int p, std::span<const Neighbor> neighbors);

/// One scan line only: the second axis has less than a tenth of the first one's variance.
bool liesOnOneLine(const PrincipalAxes& axes);

/// A unit vector perpendicular to the unit vector `normal`; depends on nothing else.
Eigen::Vector3d tangentOf(const Eigen::Vector3d& normal);

}  // namespace tufted
