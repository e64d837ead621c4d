#include "cloud/tangent_frame.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/point_buffer.h"
#include "base/power_of_two.h"

namespace tufted {

namespace {

constexpr double least_gap = 1e-3;  // between the two smallest eigenvalues over the largest, for the closed form
constexpr int most_steps = 8;

/// Upper triangle of a symmetric matrix.
struct Symmetric {
  double xx, xy, xz, yy, yz, zz;

  Eigen::Vector3d times(const Eigen::Vector3d& v) const {
    return {xx * v.x() + xy * v.y() + xz * v.z(), xy * v.x() + yy * v.y() + yz * v.z(),
            xz * v.x() + yz * v.y() + zz * v.z()};
  }
};

/// The smallest eigenvalue of a covariance by Newton's method on the characteristic polynomial, which from 0 rises to
/// its first root, and the eigenvector as a cross product. False where two eigenvalues lie too close for that.
bool findSmallest(const Symmetric& a, PrincipalAxes& axes) {
  const double yz_minor = a.yy * a.zz - a.yz * a.yz;
  const double trace = a.xx + a.yy + a.zz;
  const double minors = yz_minor + (a.xx * a.zz - a.xz * a.xz) + (a.xx * a.yy - a.xy * a.xy);
  const double determinant = a.xx * yz_minor - a.xy * (a.xy * a.zz - a.yz * a.xz) + a.xz * (a.xy * a.yz - a.yy * a.xz);
  double smallest = 0;
  bool converged = false;  // slowly towards a double root, or not at all
  for (int step = 0; step < most_steps && !converged; ++step) {
    const double value = ((smallest - trace) * smallest + minors) * smallest - determinant;
    const double slope = (3 * smallest - 2 * trace) * smallest + minors;
    const double change = value / slope;
    smallest -= change;
    converged = std::abs(change) <= 1e-9 * trace;  // and quadratic convergence has gone further
  }
  if (!converged) return false;
  const double rest = trace - smallest;  // sum and product of the other two
  const double product = minors - smallest * rest;
  const double root = std::sqrt(std::max(0.0, rest * rest - 4 * product));
  const double middle = (rest - root) / 2, largest = (rest + root) / 2;
  if (!(middle - smallest > least_gap * largest)) return false;

  const Eigen::Vector3d x(a.xx - smallest, a.xy, a.xz), y(a.xy, a.yy - smallest, a.yz), z(a.xz, a.yz, a.zz - smallest);
  const Eigen::Vector3d xy = x.cross(y), yz = y.cross(z), zx = z.cross(x);
  const double xy_square = xy.squaredNorm(), yz_square = yz.squaredNorm(), zx_square = zx.squaredNorm();
  const bool first = xy_square >= yz_square && xy_square >= zx_square;
  const Eigen::Vector3d& longest = first ? xy : yz_square >= zx_square ? yz : zx;
  axes.normal = longest / std::sqrt(first ? xy_square : std::max(yz_square, zx_square));
  axes.variance = {std::max(0.0, axes.normal.dot(a.times(axes.normal))), middle, largest};
  return true;
}

}  // namespace

void takeOffsets(const PointsView& points, int p, std::span<const Neighbor> neighbors, Offsets& offsets) {
  const double* all = points.data();
  const double* origin = all + 3 * std::ptrdiff_t{p};
  offsets.count = static_cast<int>(neighbors.size());
  for (int i = 0; i < offsets.count; ++i) {
    const double* point = all + 3 * std::ptrdiff_t{neighbors[i].index};
    offsets.x[i] = point[0] - origin[0];
    offsets.y[i] = point[1] - origin[1];
    offsets.z[i] = point[2] - origin[2];
  }
  for (int i = offsets.count; i < toLanes(offsets.count); ++i) offsets.x[i] = offsets.y[i] = offsets.z[i] = 0;
}

PrincipalAxes principalAxes(const PointsView& points, int p, std::span<const Neighbor> neighbors) {
  Offsets offsets;
  return principalAxes(points, p, neighbors, offsets);
}

PrincipalAxes principalAxes(const PointsView& points, int p, std::span<const Neighbor> neighbors, Offsets& offsets) {
  const Kernels& kernel = kernels();
  const bool is_one_part = neighbors.size() <= Offsets::most;
  if (is_one_part) takeOffsets(points, p, neighbors, offsets);
  const auto forEachPart = [&](const auto& visit) {
    if (is_one_part) return visit();
    for (std::size_t first = 0; first < neighbors.size(); first += Offsets::most) {
      const std::size_t count = std::min<std::size_t>(Offsets::most, neighbors.size() - first);
      takeOffsets(points, p, neighbors.subspan(first, count), offsets);
      visit();
    }
  };
  // The extent as a power of two keeps squares in range at any scale, exactly.
  double extent = 0;
  forEachPart([&] { extent = std::max(extent, kernel.extent(offsets)); });
  if (extent == 0) return {Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero()};
  const double power = magnitudeOf(extent), unit = 1 / power;
  OffsetSums sums;
  forEachPart([&] { kernel.addSums(offsets, unit, sums); });

  const double share = 1 / static_cast<double>(neighbors.size() + 1);  // p adds nothing but itself
  const double x = sums.sum(0) * share, y = sums.sum(1) * share, z = sums.sum(2) * share;
  const Symmetric covariance{sums.sum(3) * share - x * x, sums.sum(4) * share - x * y, sums.sum(5) * share - x * z,
                             sums.sum(6) * share - y * y, sums.sum(7) * share - y * z, sums.sum(8) * share - z * z};
  PrincipalAxes axes;
  if (!findSmallest(covariance, axes)) {
    Eigen::Matrix3d matrix;
    matrix << covariance.xx, covariance.xy, covariance.xz, covariance.xy, covariance.yy, covariance.yz, covariance.xz,
        covariance.yz, covariance.zz;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix);
    axes = {solver.eigenvectors().col(0), solver.eigenvalues()};
  }
  axes.extent = power;
  return axes;
}

bool liesOnOneLine(const PrincipalAxes& axes) {
  return axes.variance[1] < 0.1 * axes.variance[2];
}

Eigen::Vector3d tangentOf(const Eigen::Vector3d& normal) {
  int axis = 0;
  normal.cwiseAbs().minCoeff(&axis);
  return normal.cross(Eigen::Vector3d::Unit(axis)).normalized();
}

}  // namespace tufted
