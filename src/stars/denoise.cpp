#include "stars/denoise.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "stars/tangent_frame.h"

namespace tufted {
namespace {

constexpr int coefficients = 6;
constexpr int least_points = 9;
constexpr double noise_share = 0.2;
constexpr double smallest_variance = 1e-24;  // of the reach squared; below, the variance is rounding
constexpr double smallest_pivot = 1e-9;      // of the largest

/// One lane of the systems.
void put(const HeightMoments& moments, int lane, HeightSystems& systems) {
  const double* const sums = &moments.sums.u;
  for (int i = 0; i < HeightSystems::numbers; ++i) systems.sums[i][lane] = sums[i];
  systems.count[lane] = moments.count;
}

}  // namespace

HeightMoments heightMoments(const Offsets& neighbors, const Eigen::Vector3d& normal, double reach) {
  HeightMoments moments{{}, neighbors.count + 1, reach};
  if (!(reach > 0)) return moments;
  const double unit = 1 / reach;
  Eigen::Matrix3d axes;
  axes.col(0) = tangentOf(normal) * unit;
  axes.col(1) = normal.cross(axes.col(0));
  axes.col(2) = normal * unit;
  kernels().sumHeights(neighbors, axes.data(), moments.sums);
  return moments;
}

void fitHeights(std::span<const HeightMoments> moments, std::span<HeightFit> fits) {
  for (std::size_t first = 0; first < moments.size(); first += kernel_lane) {
    const auto part = moments.subspan(first, std::min<std::size_t>(kernel_lane, moments.size() - first));
    HeightSystems systems;
    HeightSolutions solutions;
    for (std::size_t i = 0; i < kernel_lane; ++i) put(part[std::min(i, part.size() - 1)], static_cast<int>(i), systems);
    kernels().solveHeights(systems, solutions);
    for (std::size_t i = 0; i < part.size(); ++i) {
      const auto& [sums, count, reach] = part[i];
      HeightFit& fit = fits[first + i] = {};
      // Points on a conic, or next to one, leave a pivot of nothing but rounding.
      if (count < least_points || !(reach > 0)) continue;
      if (!(solutions.least_pivot[i] > smallest_pivot * solutions.most_pivot[i])) continue;
      fit.height = solutions.height[i] * reach;
      const double residual = std::max(0.0, sums.hh - solutions.explained[i]);
      fit.variance = residual / static_cast<double>(count - coefficients) * reach * reach;
      fit.is_valid = std::isfinite(fit.height);
    }
  }
}

bool isNoisy(const HeightFit& fit, double variance, double reach) {
  return fit.is_valid && variance >= smallest_variance * reach * reach && fit.variance > noise_share * variance;
}

}  // namespace tufted
