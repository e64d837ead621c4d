#include "denoise/quadratic_fit.h"

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

/// Writes the sums into one lane of the systems.
void put(const HeightMoments& moments, int lane, HeightSystems& systems) {
  const double* const sums = &moments.sums.u;
  for (int i = 0; i < HeightSystems::numbers; ++i) systems.sums[i][lane] = sums[i];
  systems.count[lane] = moments.count;
}

}  // namespace

HeightMoments heightMoments(const Offsets& neighbors, const Eigen::Vector3d& normal, double fit_radius) {
  HeightMoments moments{{}, neighbors.count + 1, fit_radius};
  if (!(fit_radius > 0)) return moments;
  const double unit = 1 / fit_radius;
  Eigen::Matrix3d axes;
  axes.col(0) = tangentOf(normal) * unit;
  axes.col(1) = normal.cross(axes.col(0));
  axes.col(2) = normal * unit;
  kernels().sumHeights(neighbors, axes.data(), moments.sums);
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
      const auto& [sums, count, fit_radius] = part[i];
      HeightFit& fit = fits[first + i] = {};
      if (count < least_points || !(fit_radius > 0)) continue;
      if (!(solutions.least_pivot[i] > smallest_pivot * solutions.most_pivot[i])) continue;
      for (int j = 0; j < coefficients; ++j) fit.coefficient[j] = solutions.coefficient[j][i];
      fit.height = fit.coefficient[0] * fit_radius;
      fit.leverage = std::min(1.0, solutions.leverage[i]);
      const double residual = std::max(0.0, sums.hh - solutions.explained[i]);
      fit.variance = residual / static_cast<double>(count - coefficients) * fit_radius * fit_radius;
      fit.is_valid = std::isfinite(fit.height);
    }
  }
}

}  // namespace tufted
