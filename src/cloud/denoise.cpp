#include "cloud/denoise.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>

#include "cloud/tangent_frame.h"

namespace tufted {
namespace {

constexpr int coefficients = 6;
constexpr std::size_t least_points = 9;
constexpr double noise_share = 0.2;
constexpr double smallest_variance = 1e-24;  // of the reach squared; below, the variance is rounding
constexpr double smallest_pivot = 1e-9;      // of the largest

}  // namespace

HeightFit fitHeights(const Points& points, int p, std::span<const Neighbor> neighbors, const Eigen::Vector3d& normal,
                     double reach) {
  using Vector = Eigen::Matrix<double, coefficients, 1>;
  HeightFit fit;
  const std::size_t count = neighbors.size() + 1;
  if (count < least_points || !(reach > 0)) return fit;
  const double unit = 1 / reach;
  const Eigen::Vector3d tangent_x = tangentOf(normal), tangent_y = normal.cross(tangent_x);
  Eigen::Matrix<double, coefficients, coefficients> gram = Eigen::Matrix<double, coefficients, coefficients>::Zero();
  Vector right = Vector::Zero();
  double squares = 0;
  gram(0, 0) = 1;  // p itself, of height 0
  for (const Neighbor& q : neighbors) {
    const Eigen::Vector3d d = (points.row(q.index) - points.row(p)).transpose() * unit;
    const double u = d.dot(tangent_x), v = d.dot(tangent_y), h = d.dot(normal);
    const Vector basis = {1, u, v, u * u, u * v, v * v};
    gram.noalias() += basis * basis.transpose();
    right += h * basis;
    squares += h * h;
  }
  const Eigen::LDLT<Eigen::Matrix<double, coefficients, coefficients>> factor(gram);
  const Vector pivots = factor.vectorD();
  if (!(pivots.minCoeff() > smallest_pivot * pivots.maxCoeff())) return fit;
  const Vector solution = factor.solve(right);
  fit.height = solution[0] * reach;
  const double residual = std::max(0.0, squares - solution.dot(right));
  fit.variance = residual / static_cast<double>(count - coefficients) * reach * reach;
  fit.is_valid = std::isfinite(fit.height);
  return fit;
}

bool isNoisy(const HeightFit& fit, double variance, double reach) {
  return fit.is_valid && variance >= smallest_variance * reach * reach && fit.variance > noise_share * variance;
}

}  // namespace tufted
