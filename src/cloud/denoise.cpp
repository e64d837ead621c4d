#include "cloud/denoise.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "base/point_buffer.h"
#include "cloud/tangent_frame.h"

namespace tufted {
namespace {

constexpr int coefficients = 6;
constexpr std::size_t least_points = 9;
constexpr double noise_share = 0.2;
constexpr double smallest_variance = 1e-24;  // of the reach squared; below, the variance is rounding
constexpr double smallest_pivot = 1e-9;      // of the largest

using Vector = std::array<double, coefficients>;
using Matrix = std::array<Vector, coefficients>;

/// Lower triangle of the normal equations.
/// @param count points, that of height 0 at the origin included
Matrix gramOf(const HeightSums& s, double count) {
  return {{{count},
           {s.u, s.uu},
           {s.v, s.uv, s.vv},
           {s.uu, s.uuu, s.uuv, s.uuuu},
           {s.uv, s.uuv, s.uvv, s.uuuv, s.uuvv},
           {s.vv, s.uvv, s.vvv, s.uuvv, s.uvvv, s.vvvv}}};
}

/// Solves by L D L^T, which takes the place of the matrix. False where the points lie on a conic, or next to one.
bool solve(Matrix& gram, const Vector& right, Vector& solution) {
  Vector pivot;
  for (int j = 0; j < coefficients; ++j) {
    pivot[j] = gram[j][j];
    for (int k = 0; k < j; ++k) pivot[j] -= gram[j][k] * gram[j][k] * pivot[k];
    const double inverse = 1 / pivot[j];
    for (int i = j + 1; i < coefficients; ++i) {
      for (int k = 0; k < j; ++k) gram[i][j] -= gram[i][k] * gram[j][k] * pivot[k];
      gram[i][j] *= inverse;
    }
  }
  const auto [least, most] = std::minmax_element(pivot.begin(), pivot.end());
  if (!(*least > smallest_pivot * *most)) return false;
  solution = right;
  for (int i = 0; i < coefficients; ++i)
    for (int k = 0; k < i; ++k) solution[i] -= gram[i][k] * solution[k];
  for (int i = coefficients - 1; i >= 0; --i) {
    solution[i] /= pivot[i];
    for (int k = i + 1; k < coefficients; ++k) solution[i] -= gram[k][i] * solution[k];
  }
  return true;
}

}  // namespace

HeightFit fitHeights(const PointsView& points, int p, std::span<const Neighbor> neighbors,
                     const Eigen::Vector3d& normal, double reach, const Offsets* taken) {
  HeightFit fit;
  const std::size_t count = neighbors.size() + 1;
  if (count < least_points || !(reach > 0)) return fit;
  const double unit = 1 / reach;
  Eigen::Matrix3d axes;
  axes.col(0) = tangentOf(normal) * unit;
  axes.col(1) = normal.cross(axes.col(0));
  axes.col(2) = normal * unit;
  HeightSums sums{};
  Offsets part;
  if (taken != nullptr) {
    kernels().addHeights(*taken, axes.data(), sums);
  } else {
    forEachPart(points, p, neighbors, part, [&] { kernels().addHeights(part, axes.data(), sums); });
  }

  const Vector right = {sums.h, sums.hu, sums.hv, sums.huu, sums.huv, sums.hvv};
  Matrix gram = gramOf(sums, static_cast<double>(count));
  Vector solution;
  if (!solve(gram, right, solution)) return fit;
  fit.height = solution[0] * reach;
  double explained = 0;
  for (int i = 0; i < coefficients; ++i) explained += solution[i] * right[i];
  const double residual = std::max(0.0, sums.hh - explained);
  fit.variance = residual / static_cast<double>(count - coefficients) * reach * reach;
  fit.is_valid = std::isfinite(fit.height);
  return fit;
}

bool isNoisy(const HeightFit& fit, double variance, double reach) {
  return fit.is_valid && variance >= smallest_variance * reach * reach && fit.variance > noise_share * variance;
}

}  // namespace tufted
