#include "cloud/tangent_frame.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace tufted {

PrincipalAxes principalAxes(const Points& points, int p, std::span<const Neighbor> neighbors) {
  // The extent as a power of two keeps squares in range at any scale, exactly.
  double extent = 0;
  for (const Neighbor& q : neighbors) {
    extent = std::max(extent, (points.row(q.index) - points.row(p)).cwiseAbs().maxCoeff());
  }
  if (extent == 0) return {Eigen::Vector3d::UnitZ(), Eigen::Vector3d::Zero()};
  const int exponent = std::max(std::ilogb(extent), -1022);
  const double unit = std::ldexp(1.0, -exponent);  // finite for any extent

  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const Neighbor& q : neighbors) {
    const Eigen::Vector3d d = (points.row(q.index) - points.row(p)).transpose() * unit;
    sum += d;
    moments.noalias() += d * d.transpose();
  }
  const double count = static_cast<double>(neighbors.size() + 1);  // p adds nothing but itself
  const Eigen::Matrix3d covariance = moments / count - (sum / count) * (sum / count).transpose();

  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance);
  PrincipalAxes axes{solver.eigenvectors().col(0), solver.eigenvalues()};
  // The closed form may fail where two eigenvalues meet; the iteration does not.
  if (!(std::abs(axes.normal.squaredNorm() - 1) < 1e-12) || !axes.variance.allFinite()) {
    solver.compute(covariance);
    axes = {solver.eigenvectors().col(0), solver.eigenvalues()};
  }
  axes.extent = std::ldexp(1.0, exponent);
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
