#include "algorithms/height_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace tufted {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// A pivot below this part of the largest means that a combination of the columns vanishes on all samples.
constexpr double least_pivot = 1e-9;

/// The terms of a fit; quadratic ones of the coordinates that are stretched to the whole distance.
Vector6 terms(const HeightSample& s) {
  const double flat = s.u * s.u + s.v * s.v;
  const double stretch = flat > std::numeric_limits<double>::min() ? 1 + s.height * s.height / flat : 1;
  return {1, s.u, s.v, stretch * s.u * s.u / 2, stretch * s.u * s.v, stretch * s.v * s.v / 2};
}

double weightOf(const HeightSample& s) {
  const double inner = std::max(0.0, 1 - s.u * s.u - s.v * s.v - s.height * s.height);
  return inner * inner;
}

}  // namespace

std::optional<SurfaceFit> fitHeights(std::span<const HeightSample> samples) {
  Matrix6 normal = Matrix6::Zero(), squared = Matrix6::Zero();
  Vector6 right = Vector6::Zero();
  double weights = 0;
  for (const HeightSample& s : samples) {
    const double weight = weightOf(s);
    const Vector6 row = terms(s);
    normal.noalias() += weight * row * row.transpose();
    squared.noalias() += weight * weight * row * row.transpose();
    right += weight * s.height * row;
    weights += weight;
  }
  const Eigen::LDLT<Matrix6> factor(normal);
  const Vector6 pivots = factor.vectorD();
  if (!(pivots.minCoeff() > least_pivot * pivots.maxCoeff())) return std::nullopt;
  SurfaceFit fit;
  fit.coefficients = factor.solve(right);
  double left = 0;
  for (const HeightSample& s : samples) {
    const double rest = s.height - terms(s).dot(fit.coefficients);
    left += weightOf(s) * rest * rest;
  }
  // Of independent errors: sum w e^2 has the mean variance * (sum w - trace(N^-1 sum w^2 r r^T)).
  const Matrix6 spread = factor.solve(squared);
  const double freedom = weights - spread.trace();
  fit.error = freedom > 0 ? std::sqrt(left / freedom) : INFINITY;
  const Matrix6 covariance = factor.solve(spread.transpose());
  fit.deviation = covariance.diagonal().tail<3>().cwiseMax(0).cwiseSqrt();
  return fit;
}

}  // namespace tufted
