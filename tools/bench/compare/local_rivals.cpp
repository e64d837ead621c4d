// Rivals whose rows come from the star or the fit of one point each.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "bench/compare/patches.h"
#include "bench/compare/rivals.h"

namespace tufted::bench {
namespace {

double crossOf(const Eigen::RowVector2d& a, const Eigen::RowVector2d& b) {
  return a[0] * b[1] - a[1] * b[0];
}

/// Weights of a point's star by its cotans in space, and a third of its areas.
std::vector<Eigen::Triplet<double>> cotanWeights(const Points& points, int k, VectorXd& areas) {
  const NearestPoints nearest(points);
  areas = VectorXd::Zero(points.rows());
  std::vector<Eigen::Triplet<double>> weights;
  for (int p = 0; p < points.rows(); ++p) {
    const Patch patch = patchOf(nearest, p, k);
    for (const auto& [i, j] : starOf(patch, k).triangles) {
      const int a = patch.index[i], b = patch.index[j];
      const Eigen::RowVector3d pa = points.row(a) - points.row(p), pb = points.row(b) - points.row(p), ab = pb - pa;
      const double twice_area = std::sqrt(std::max(0.0, pa.squaredNorm() * pb.squaredNorm() - std::pow(pa.dot(pb), 2)));
      if (!(twice_area > 0)) continue;
      weights.emplace_back(p, a, ab.dot(pb) / twice_area / 2);
      weights.emplace_back(p, b, -ab.dot(pa) / twice_area / 2);
      areas[p] += twice_area / 6;
    }
  }
  return weights;
}

/// Coefficients of the Laplacian on the surface z(x, y) in (u_x, u_y, u_xx, u_xy, u_yy), from those of z.
Eigen::Matrix<double, 1, 5> laplaceBeltrami(const Eigen::Matrix<double, 5, 1>& z) {
  const double p = z[0], q = z[1], root = 1 + p * p + q * q;
  const double xx = 1 - p * p / root, xy = -p * q / root, yy = 1 - q * q / root;  // the inverse metric
  const double bend = (xx * z[2] + 2 * xy * z[3] + yy * z[4]) / root;
  return {-bend * p, -bend * q, xx, 2 * xy, yy};
}

}  // namespace

VectorXd starAreas(const Points& points) {
  const NearestPoints nearest(points);
  VectorXd areas = VectorXd::Zero(points.rows());
  for (int p = 0; p < points.rows(); ++p) {
    const Patch patch = patchOf(nearest, p, plane_neighbors);
    for (const auto& [i, j] : starOf(patch, plane_neighbors).triangles) {
      const Eigen::RowVector2d a = patch.plane.row(i), b = patch.plane.row(j);
      const double twice_area = crossOf(a, b), at_p = a.dot(b), at_a = a.dot(a - b), at_b = b.dot(b - a);
      if (at_p < 0)
        areas[p] += twice_area / 4;
      else if (at_a < 0 || at_b < 0)
        areas[p] += twice_area / 8;
      else  // Equation 7
        areas[p] += (a.squaredNorm() * at_b + b.squaredNorm() * at_a) / twice_area / 8;
    }
  }
  return areas;
}

Operators localCotanLaplacian(const Points& points, int k) {
  VectorXd areas;
  const auto weights = cotanWeights(points, k, areas);
  return {fromWeights(weights, points.rows()), areas};
}

Operators meanCotanLaplacian(const Points& points, int k) {
  VectorXd areas;
  std::vector<Eigen::Triplet<double>> both;
  for (const auto& weight : cotanWeights(points, k, areas)) {
    both.emplace_back(weight.row(), weight.col(), weight.value() / 2);
    both.emplace_back(weight.col(), weight.row(), weight.value() / 2);
  }
  return {fromWeights(both, points.rows()), areas};
}

Operators leastSquaresLaplacian(const Points& points, int k) {
  const VectorXd areas = starAreas(points);
  const NearestPoints nearest(points);
  std::vector<Eigen::Triplet<double>> weights;
  for (int p = 0; p < points.rows(); ++p) {
    const Patch patch = patchOf(nearest, p, k);
    const auto n = static_cast<Eigen::Index>(patch.index.size());
    const VectorXd distance = (patch.plane.rowwise().squaredNorm() + patch.height.cwiseAbs2()).cwiseSqrt();
    const double radius = distance.maxCoeff();
    Eigen::MatrixXd basis(n, 5);
    const auto x = patch.plane.col(0).array() / radius, y = patch.plane.col(1).array() / radius;
    basis << x, y, x * x / 2, x * y, y * y / 2;
    const VectorXd root = (1 - distance.array() / radius).square();  // of the weights (1 - d / R)^4, usual for GMLS
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(root.asDiagonal() * basis);
    if (qr.rank() < 5) continue;
    const Eigen::MatrixXd fit = qr.solve(Eigen::MatrixXd(root.asDiagonal()));  // 5 x n: coefficients from values
    const Eigen::RowVectorXd row = laplaceBeltrami(fit * patch.height / radius) * fit / (radius * radius);
    for (Eigen::Index j = 0; j < n; ++j)
      weights.emplace_back(p, patch.index[static_cast<std::size_t>(j)], areas[p] * row[j]);
  }
  return {fromWeights(weights, points.rows()), areas};
}

}  // namespace tufted::bench
