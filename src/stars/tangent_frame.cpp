// Section 5.7 of the paper: the tangent plane through the neighbours, by principal component analysis.
#include "stars/tangent_frame.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "base/point_buffer.h"
#include "base/power_of_two.h"
#include "base/symmetric_eigen.h"
#include "stars/offsets.h"

namespace tufted {

namespace {

/// Neighbours whose second variance is below this share of the largest lie on one line. With a fixed k scan lines of
/// anisotropy 20 fall apart into thousands of components.
constexpr double line_share = 0.1;
/// Neighbourhoods whose smallest variance exceeds this share of the second are thick: 84 % of those on a cable 8
/// spacings around, 7 % on one of 11, and 78 % in a volume.
constexpr double thick_share = 0.5;

/// The axes by Eigen's iteration, for covariances with two nearly equal eigenvalues.
PrincipalAxes carefulAxes(const Covariance& a) {
  Eigen::Matrix3d matrix;
  matrix << a.xx, a.xy, a.xz, a.xy, a.yy, a.yz, a.xz, a.yz, a.zz;
  const auto solver = symmetricEigen(matrix);
  return {solver.eigenvectors().col(0), solver.eigenvalues(), a.extent};
}

}  // namespace

void findCovariances(const Offsets& neighbors, double size, std::span<const int> ends,
                     std::span<Covariance> covariances) {
  const Kernels& kernel = kernels();
  if (!(size > 0)) size = kernel.extent(neighbors);
  if (size == 0) {
    std::ranges::fill(covariances, Covariance());
    return;
  }
  // Dividing by a power of two is exact and keeps squares in range.
  const double power = magnitudeOf(size);
  std::array<OffsetSums, most_sets> sums;
  kernel.sumOffsets(neighbors, 1 / power, ends.data(), static_cast<int>(ends.size()), sums.data());
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const OffsetSums& sum = sums[i];
    const double share = 1 / static_cast<double>(ends[i] + 1);  // p counts, with offset 0
    const double x = sum.x * share, y = sum.y * share, z = sum.z * share;
    covariances[i] = {sum.xx * share - x * x,
                      sum.xy * share - x * y,
                      sum.xz * share - x * z,
                      sum.yy * share - y * y,
                      sum.yz * share - y * z,
                      sum.zz * share - z * z,
                      power};
  }
}

Covariance covarianceOf(const Offsets& neighbors, double size) {
  Covariance covariance;
  findCovariances(neighbors, size, {&neighbors.count, 1}, {&covariance, 1});
  return covariance;
}

void principalAxes(std::span<const Covariance> covariances, std::span<PrincipalAxes> axes) {
  const Kernels& kernel = kernels();
  for (std::size_t first = 0; first < covariances.size(); first += kernel_packet) {
    const auto part = covariances.subspan(first, std::min<std::size_t>(kernel_packet, covariances.size() - first));
    Covariances covariances_by_lane;
    SmallestAxes found;
    for (std::size_t i = 0; i < kernel_packet; ++i) {
      const Covariance& a = part[std::min(i, part.size() - 1)];
      covariances_by_lane.xx[i] = a.xx;
      covariances_by_lane.xy[i] = a.xy;
      covariances_by_lane.xz[i] = a.xz;
      covariances_by_lane.yy[i] = a.yy;
      covariances_by_lane.yz[i] = a.yz;
      covariances_by_lane.zz[i] = a.zz;
    }
    kernel.findSmallest(covariances_by_lane, found);
    for (std::size_t i = 0; i < part.size(); ++i) {
      PrincipalAxes& of_part = axes[first + i];
      if (part[i].extent == 0)
        of_part = {Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero()};
      else if (found.is_found[i] != 0)
        of_part = {{found.x[i], found.y[i], found.z[i]},
                   {found.smallest[i], found.middle[i], found.largest[i]},
                   part[i].extent};
      else
        of_part = carefulAxes(part[i]);
    }
  }
}

PrincipalAxes principalAxes(const Offsets& neighbors) {
  const Covariance covariance = covarianceOf(neighbors);
  PrincipalAxes axes;
  principalAxes({&covariance, 1}, {&axes, 1});
  return axes;
}

PrincipalAxes principalAxes(const PointsView& points, int p, std::span<const Neighbor> neighbors) {
  OffsetBuffer offsets;
  offsets.take(points, p, neighbors);
  return principalAxes(offsets.view());
}

bool liesOnOneLine(const PrincipalAxes& axes) {
  return axes.variance[1] < line_share * axes.variance[2];
}

bool areThick(const PrincipalAxes& axes) {
  return axes.variance[0] > thick_share * axes.variance[1] && !liesOnOneLine(axes);
}

Eigen::Vector3d tangentOf(const Eigen::Vector3d& normal) {
  int axis = 0;
  normal.cwiseAbs().minCoeff(&axis);
  return normal.cross(Eigen::Vector3d::Unit(axis)).normalized();
}

}  // namespace tufted
