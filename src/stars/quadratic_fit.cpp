#include "stars/quadratic_fit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "stars/tangent_frame.h"

namespace tufted {
namespace {

/// Number of coefficients of a quadratic in two variables.
constexpr int coefficients = 6;
/// Least number of points of a fit: three more than coefficients, so that residuals can show how good it is.
constexpr int least_points = 9;
/// A pivot below this share of the largest is rounding: points on a conic determine no quadratic.
constexpr double smallest_pivot = 1e-9;

/// The axes of the plane and the normal, as columns, in units of the radius.
Eigen::Matrix3d axesOver(const Eigen::Vector3d& normal, double fit_radius) {
  const double unit = 1 / fit_radius;
  Eigen::Matrix3d axes;
  axes.col(0) = tangentOf(normal) * unit;
  axes.col(1) = normal.cross(axes.col(0));
  axes.col(2) = normal * unit;
  return axes;
}

/// Writes the sums into one lane of the systems.
void put(const HeightMoments& moments, int lane, HeightSystems& systems) {
  const double* const sums = &moments.sums.u;
  for (int i = 0; i < HeightSystems::numbers; ++i) systems.sums[i][lane] = sums[i];
  systems.count[lane] = moments.weight;
}

}  // namespace

HeightMoments heightMoments(const Offsets& neighbors, const Eigen::Vector3d& normal, double fit_radius) {
  HeightMoments moments{{}, neighbors.count + 1, neighbors.count + 1.0, fit_radius};
  if (fit_radius > 0) kernels().sumHeights(neighbors, axesOver(normal, fit_radius).data(), moments.sums);
  return moments;
}

HeightMoments weightedMoments(const Offsets& neighbors, const Eigen::Vector3d& normal, double fit_radius) {
  HeightMoments moments{{}, neighbors.count + 1, 1, fit_radius};
  if (fit_radius > 0)
    moments.weight += kernels().sumWeightedHeights(neighbors, axesOver(normal, fit_radius).data(), moments.sums);
  return moments;
}

void fitHeights(std::span<const HeightMoments> moments, std::span<HeightFit> fits) {
  for (std::size_t first = 0; first < moments.size(); first += kernel_packet) {
    const auto part = moments.subspan(first, std::min<std::size_t>(kernel_packet, moments.size() - first));
    HeightSystems systems;
    HeightSolutions solutions;
    for (std::size_t i = 0; i < kernel_packet; ++i)
      put(part[std::min(i, part.size() - 1)], static_cast<int>(i), systems);
    kernels().solveHeights(systems, solutions);
    for (std::size_t i = 0; i < part.size(); ++i) {
      const auto& [sums, count, weight, fit_radius] = part[i];
      HeightFit& fit = fits[first + i] = {};
      if (count < least_points || !(fit_radius > 0)) continue;
      if (!(solutions.least_pivot[i] > smallest_pivot * solutions.most_pivot[i])) continue;
      for (int j = 0; j < coefficients; ++j) fit.coefficient[j] = solutions.coefficient[j][i];
      fit.height = fit.coefficient[0] * fit_radius;
      fit.leverage = std::min(1.0, solutions.leverage[i]);
      const double residual = std::max(0.0, sums.hh - solutions.explained[i]);
      fit.variance = residual / static_cast<double>(count - coefficients) * fit_radius * fit_radius;
      fit.least_pivot = solutions.least_pivot[i];
      fit.is_valid = std::isfinite(fit.height);
    }
  }
}

HeightFit fitHeights(const HeightMoments& moments) {
  HeightFit fit;
  fitHeights({&moments, 1}, {&fit, 1});
  return fit;
}

Eigen::Vector3d normalOf(const HeightFit& fit, const Eigen::Vector3d& normal) {
  const Eigen::Vector3d u = tangentOf(normal), v = normal.cross(u);
  return (normal - fit.coefficient[1] * u - fit.coefficient[2] * v).normalized();
}

}  // namespace tufted
