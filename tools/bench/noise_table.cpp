// Distances of denoised points from the surface, and the accuracy of their Laplacians.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "bench/pcl_rivals.h"
#include "bench/tables.h"
#include "oracles/oracles.h"
#include "shapes/distances.h"
#include "shapes/shapes.h"
#include "tufted/denoise.h"
#include "tufted/laplacian.h"

namespace tufted::bench {
namespace {

using shapes::Cloud;
using shapes::rmsDistance;
using shapes::Sampling;

constexpr int points = 16000;

/// A row of the table.
struct NoisyShape {
  std::string name;
  std::function<Cloud(std::uint64_t seed)> make;
  double sigma;
  shapes::SurfaceDistance distance;  ///< distance of a point from the surface
  int eigenvalues = 29;
};

std::vector<NoisyShape> noisyShapes() {
  const auto sphere = [](std::uint64_t seed) { return shapes::sphere(points, Sampling::uniform, seed); };
  const auto lines = [](std::uint64_t) { return shapes::sphere(points, Sampling::scanLines(20)); };
  const auto torus = [](std::uint64_t seed) { return shapes::torus(points, Sampling::uniform, seed); };
  const auto patch = [](std::uint64_t seed) {
    return shapes::cylinderPatch(points, Sampling::uniform, shapes::Rim::included, seed);
  };
  const auto cube = [](std::uint64_t seed) { return shapes::cubeSurface(points, seed); };
  const auto planes = [](std::uint64_t seed) { return shapes::crossingPlanes(points, seed); };
  const auto to_cylinder = [](const Eigen::RowVector3d& x) { return std::hypot(x[0], x[1]) - 1; };
  const auto to_planes = [](const Eigen::RowVector3d& x) { return std::min(std::abs(x[1]), std::abs(x[2])); };
  const double half_spacing = std::sqrt(std::numbers::pi / points);  // half the spacing on the sphere
  std::vector<NoisyShape> rows;
  for (const auto& [name, sigma] : {std::pair("sphere .25 %", 0.0025),
                                    {"sphere .5 %", 0.005},
                                    {"sphere 1 %", 0.01},
                                    {"sphere 2 %", 0.02},
                                    {"sphere 4 %", 0.04}})
    rows.push_back({name, sphere, sigma, shapes::toSphere});
  for (const auto& [name, sigma] : {std::pair("torus .25 %", 0.0025), {"torus 1 %", 0.01}, {"torus 2 %", 0.02}})
    rows.push_back({name, torus, sigma, shapes::toTorus});
  rows.push_back({"sphere, lines 1:20, half a spacing", lines, half_spacing, shapes::toSphere, 32});
  rows.push_back({"half cylinder 1 %", patch, 0.01, to_cylinder});
  rows.push_back({"cube .25 %", cube, 0.0025, shapes::toCube});
  rows.push_back({"cube 1 %", cube, 0.01, shapes::toCube});
  rows.push_back({"crossing planes 1 %", planes, 0.01, to_planes});
  return rows;
}

double eigenvalueError(const Laplacian& laplacian, const Cloud& cloud, int count) {
  const VectorXd found = oracles::smallestEigenvalues(laplacian.L, laplacian.M, count + 1);
  return oracles::meanRelativeError(found, cloud.eigenvalues.head(count + 1));
}

}  // namespace

void printNoise() {
  std::printf(
      "\n| shape, noise | rms off the surface, spacings | after denoise | MLS, best radius | estimated / true noise | "
      "eigenvalue error, points as measured | by default | area | by default "
      "|\n|---|---|---|---|---|---|---|---|---|\n");
#ifdef TUFTED_BENCH_PCL
  const std::vector<double> radii = {3, 4, 6, 8, 10};  // in spacings
#else
  const std::vector<double> radii;
#endif
  for (const NoisyShape& shape : noisyShapes()) {
    double before = 0, after = 0, noise = 0, error_before = 0, error_after = 0, area_before = 0, area_after = 0,
           spacing = 0;
    std::vector<double> others(radii.size(), 0);
    for (std::uint64_t seed = first_seed; seed <= last_seed; ++seed) {
      const Cloud cloud = withNoise(shape.make(seed), shape.sigma, seed + 100);
      spacing = std::sqrt(cloud.area / static_cast<double>(cloud.points.rows()));
      const DenoisedPoints done = denoise(cloud.points);
      before += rmsDistance(cloud.points, shape.distance) / spacing;
      after += rmsDistance(done.positions, shape.distance) / spacing;
      noise += done.report.noise / shape.sigma;
      CloudOptions as_measured;
      as_measured.steps.denoise = false;
      const Laplacian before_moving = pointCloudLaplacian(cloud.points, as_measured);
      const Laplacian after_moving = pointCloudLaplacian(cloud.points);
      error_before += eigenvalueError(before_moving, cloud, shape.eigenvalues);
      error_after += eigenvalueError(after_moving, cloud, shape.eigenvalues);
      area_before += before_moving.report.area / cloud.area - 1;
      area_after += after_moving.report.area / cloud.area - 1;
#ifdef TUFTED_BENCH_PCL
      for (std::size_t r = 0; r < radii.size(); ++r)
        others[r] += rmsDistance(movedByLeastSquares(cloud.points, radii[r] * spacing, 2), shape.distance) / spacing;
#endif
    }
    constexpr double seeds = last_seed - first_seed + 1;
    std::printf("| %s | %.3f | %.3f | ", shape.name.c_str(), before / seeds, after / seeds);
    if (const auto best = std::min_element(others.begin(), others.end()); best != others.end())
      std::printf("%.3f (%g)", *best / seeds, radii[static_cast<std::size_t>(best - others.begin())]);
    std::printf(" | %.2f | %.1e | %.1e | %+.1f %% | %+.1f %% |\n", noise / seeds, error_before / seeds,
                error_after / seeds, 100 * area_before / seeds, 100 * area_after / seeds);
    std::fflush(stdout);
  }
}

}  // namespace tufted::bench
