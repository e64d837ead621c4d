#include "algorithms/height_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace tufted {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// A pivot below this part of the largest counts as 0: points on a line or a conic do not determine the fit.
constexpr double least_pivot = 1e-9;

/// Samples that vector instructions treat at once.
constexpr int lanes = 4;
using Lanes = Eigen::Array<double, lanes, 1>;

/// Samples in units of the radius, as terms of the fit.
struct Terms {
  std::array<Lanes, 6> row;  ///< 1, u, v, U^2 / 2, U V, V^2 / 2, see SurfaceFit
  Lanes height, weight;
};

Terms termsOf(const Lanes& u, const Lanes& v, const Lanes& height) {
  const Lanes flat = u * u + v * v, squared_height = height * height;
  const Lanes inner = (1 - flat - squared_height).max(0);
  const Lanes stretch = (flat > std::numeric_limits<double>::min()).select(1 + squared_height / flat, 1);
  return {.row = {Lanes::Ones(), u, v, stretch * u * u / 2, stretch * u * v, stretch * v * v / 2},
          .height = height,
          .weight = inner * inner};
}

/// Calls `take` with the terms of all samples. The last lanes are filled up with samples of weight 0.
template <class Take>
void forTerms(const HeightSamples& samples, double radius, const Take& take) {
  const std::size_t count = samples.u.size(), whole = count - count % lanes;
  const double scale = 1 / radius;
  for (std::size_t i = 0; i < whole; i += lanes)
    take(termsOf(scale * Eigen::Map<const Lanes>(&samples.u[i]), scale * Eigen::Map<const Lanes>(&samples.v[i]),
                 scale * Eigen::Map<const Lanes>(&samples.height[i])));
  if (whole == count) return;
  Lanes u = Lanes::Zero(), v = u, height = Lanes::Ones();
  for (std::size_t i = whole; i < count; ++i) {
    const auto lane = static_cast<Eigen::Index>(i - whole);
    u[lane] = scale * samples.u[i];
    v[lane] = scale * samples.v[i];
    height[lane] = scale * samples.height[i];
  }
  take(termsOf(u, v, height));
}

}  // namespace

std::optional<SurfaceFit> fitHeights(const HeightSamples& samples, double radius) {
  // Lower triangles of the symmetric matrices sum w r r^T and sum w^2 r r^T, row by row.
  std::array<Lanes, 21> sums, squared_sums;
  std::array<Lanes, 6> right_sums;
  sums.fill(Lanes::Zero());
  squared_sums.fill(Lanes::Zero());
  right_sums.fill(Lanes::Zero());
  Lanes weights = Lanes::Zero();
  forTerms(samples, radius, [&](const Terms& terms) {
    const Lanes squared = terms.weight * terms.weight, pull = terms.weight * terms.height;
    for (std::size_t a = 0, k = 0; a < 6; ++a) {
      for (std::size_t b = 0; b <= a; ++b, ++k) {
        const Lanes product = terms.row[a] * terms.row[b];
        sums[k] += terms.weight * product;
        squared_sums[k] += squared * product;
      }
      right_sums[a] += pull * terms.row[a];
    }
    weights += terms.weight;
  });
  Matrix6 normal, squared;
  Vector6 right;
  for (std::size_t a = 0, k = 0; a < 6; ++a) {
    const auto row = static_cast<Eigen::Index>(a);
    for (Eigen::Index b = 0; b <= row; ++b, ++k) {
      normal(row, b) = normal(b, row) = sums[k].sum();
      squared(row, b) = squared(b, row) = squared_sums[k].sum();
    }
    right[row] = right_sums[a].sum();
  }
  const Eigen::LDLT<Matrix6> factor(normal);
  const Vector6 pivots = factor.vectorD();
  if (!(pivots.minCoeff() > least_pivot * pivots.maxCoeff())) return std::nullopt;
  SurfaceFit fit;
  fit.coefficients = factor.solve(right);
  // For independent errors, sum w e^2 has the mean variance * (sum w - trace(N^-1 sum w^2 r r^T)).
  const Matrix6 inverse = factor.solve(Matrix6::Identity());
  fit.freedom = weights.sum() - inverse.cwiseProduct(squared).sum();
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Vector6 column = inverse.col(3 + i);
    fit.deviation[i] = std::sqrt(std::max(0.0, column.dot(squared * column)));
  }
  return fit;
}

double errorOf(const SurfaceFit& fit, const HeightSamples& samples, double radius) {
  if (!(fit.freedom > 0)) return INFINITY;
  Lanes left = Lanes::Zero();
  forTerms(samples, radius, [&](const Terms& terms) {
    Lanes rest = terms.height;
    for (std::size_t a = 0; a < 6; ++a) rest -= fit.coefficients[static_cast<Eigen::Index>(a)] * terms.row[a];
    left += terms.weight * rest * rest;
  });
  return std::sqrt(left.sum() / fit.freedom);
}

}  // namespace tufted
