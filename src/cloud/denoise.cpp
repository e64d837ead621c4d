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

/// Two doubles that are worked on together, by every processor with the same bits as one after the other.
using Pair = double __attribute__((vector_size(16)));

double total(Pair a) {
  return a[0] + a[1];
}

/// Sums over the neighbours, of every other one each: what the normal equations over {1, u, v, u^2, u v, v^2} consist
/// of.
struct Moments {
  Pair u = {}, v = {}, uu = {}, uv = {}, vv = {}, uuu = {}, uuv = {}, uvv = {}, vvv = {};
  Pair uuuu = {}, uuuv = {}, uuvv = {}, uvvv = {}, vvvv = {};
  Pair h = {}, hu = {}, hv = {}, huu = {}, huv = {}, hvv = {}, hh = {};

  void add(Pair a, Pair b, Pair height) {
    const Pair aa = a * a, ab = a * b, bb = b * b;
    u += a, v += b, uu += aa, uv += ab, vv += bb;
    uuu += aa * a, uuv += aa * b, uvv += a * bb, vvv += bb * b;
    uuuu += aa * aa, uuuv += aa * ab, uuvv += aa * bb, uvvv += ab * bb, vvvv += bb * bb;
    h += height, hu += height * a, hv += height * b, huu += height * aa, huv += height * ab, hvv += height * bb;
    hh += height * height;
  }

  /// Lower triangle.
  /// @param count points, that of height 0 at the origin included
  Matrix gram(double count) const {
    return {{{count},
             {total(u), total(uu)},
             {total(v), total(uv), total(vv)},
             {total(uu), total(uuu), total(uuv), total(uuuu)},
             {total(uv), total(uuv), total(uvv), total(uuuv), total(uuvv)},
             {total(vv), total(uvv), total(vvv), total(uuvv), total(uvvv), total(vvvv)}}};
  }
  Vector right() const { return {total(h), total(hu), total(hv), total(huu), total(huv), total(hvv)}; }
};

/// Solves by L D L^T. False where the points lie on a conic, or next to one.
bool solve(Matrix gram, const Vector& right, Vector& solution) {
  Vector pivot;
  for (int j = 0; j < coefficients; ++j) {
    pivot[j] = gram[j][j];
    for (int k = 0; k < j; ++k) pivot[j] -= gram[j][k] * gram[j][k] * pivot[k];
    for (int i = j + 1; i < coefficients; ++i) {
      for (int k = 0; k < j; ++k) gram[i][j] -= gram[i][k] * gram[j][k] * pivot[k];
      gram[i][j] /= pivot[j];
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
                     const Eigen::Vector3d& normal, double reach) {
  HeightFit fit;
  const std::size_t count = neighbors.size() + 1;
  if (count < least_points || !(reach > 0)) return fit;
  const double unit = 1 / reach;
  const Eigen::Vector3d x = tangentOf(normal) * unit, y = normal.cross(x), z = normal * unit;
  const double* origin = points.data() + 3 * std::ptrdiff_t{p};
  Moments sum;
  for (std::size_t i = 0; i < neighbors.size(); i += 2) {
    Pair dx = {}, dy = {}, dz = {};  // of the second 0, which adds nothing, where there is none
    for (std::size_t j = 0; j < 2 && i + j < neighbors.size(); ++j) {
      const double* point = points.data() + 3 * std::ptrdiff_t{neighbors[i + j].index};
      dx[j] = point[0] - origin[0];
      dy[j] = point[1] - origin[1];
      dz[j] = point[2] - origin[2];
    }
    sum.add(dx * x[0] + dy * x[1] + dz * x[2], dx * y[0] + dy * y[1] + dz * y[2], dx * z[0] + dy * z[1] + dz * z[2]);
  }

  Vector solution;
  if (!solve(sum.gram(static_cast<double>(count)), sum.right(), solution)) return fit;
  fit.height = solution[0] * reach;
  double explained = 0;
  for (int i = 0; i < coefficients; ++i) explained += solution[i] * sum.right()[i];
  const double residual = std::max(0.0, total(sum.hh) - explained);
  fit.variance = residual / static_cast<double>(count - coefficients) * reach * reach;
  fit.is_valid = std::isfinite(fit.height);
  return fit;
}

bool isNoisy(const HeightFit& fit, double variance, double reach) {
  return fit.is_valid && variance >= smallest_variance * reach * reach && fit.variance > noise_share * variance;
}

}  // namespace tufted
