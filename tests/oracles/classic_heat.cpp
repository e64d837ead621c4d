#include "oracles/classic_heat.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <cmath>

#include "oracles/oracles.h"

namespace tufted::oracles {

VectorXd classicHeatDistances(const Points& points, const Triangles& triangles, int source) {
  const Operators operators = cotanLaplacian(points, triangles);
  double squares = 0;
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k)
      squares += (points.row(triangles(f, k)) - points.row(triangles(f, (k + 1) % 3))).squaredNorm();
  }
  const double t = squares / static_cast<double>(3 * triangles.rows());
  SparseMatrix heat = t * operators.L, grounded = operators.L;
  for (Eigen::Index i = 0; i < points.rows(); ++i) heat.coeffRef(i, i) += operators.M[i];
  VectorXd delta = VectorXd::Zero(points.rows());
  delta[source] = 1;
  const Eigen::SimplicialLDLT<SparseMatrix> heat_factor(heat);
  if (heat_factor.info() != Eigen::Success) return VectorXd::Constant(points.rows(), NAN);
  const VectorXd u = heat_factor.solve(delta);

  VectorXd divergence = VectorXd::Zero(points.rows());
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    const Eigen::Matrix3d corners = points(triangles.row(f), Eigen::all);
    const Eigen::RowVector3d normal = (corners.row(1) - corners.row(0)).cross(corners.row(2) - corners.row(0));
    if (!(normal.norm() > 0)) continue;
    const Eigen::RowVector3d unit = normal.normalized();
    Eigen::RowVector3d gradient = Eigen::RowVector3d::Zero();
    for (int k = 0; k < 3; ++k) {
      gradient += u[triangles(f, k)] * unit.cross(corners.row((k + 2) % 3) - corners.row((k + 1) % 3));
    }
    if (!(gradient.norm() > 0)) continue;
    // The integral of X times the gradient of a hat function, in which the area cancels.
    for (int k = 0; k < 3; ++k) {
      divergence[triangles(f, k)] -=
          gradient.normalized().dot(unit.cross(corners.row((k + 2) % 3) - corners.row((k + 1) % 3))) / 2;
    }
  }
  // The solution is determined up to a constant, so it is pinned to 0 at the source.
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    if (grounded.coeff(i, i) == 0) grounded.coeffRef(i, i) = 1;
  }
  grounded.prune([&](Eigen::Index i, Eigen::Index j, double) { return (i != source && j != source) || i == j; });
  divergence[source] = 0;
  const Eigen::SimplicialLDLT<SparseMatrix> grounded_factor(grounded);
  if (grounded_factor.info() != Eigen::Success) return VectorXd::Constant(points.rows(), NAN);
  const VectorXd distance = grounded_factor.solve(divergence);
  return distance.array() - distance[source];
}

}  // namespace tufted::oracles
