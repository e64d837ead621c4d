// How close to the surface points come, and what their Laplacian is worth then.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "bench/moving_least_squares.h"
#include "bench/shape_tables.h"
#include "oracles/oracles.h"
#include "shapes/shapes.h"
#include "tufted/denoise.h"
#include "tufted/laplacian.h"

namespace tufted::bench {
namespace {

using shapes::Cloud;
using shapes::Sampling;

constexpr std::uint64_t first_seed = 101, last_seed = 105;
constexpr int points = 16000;

/// A row of the table.
struct NoisyShape {
  std::string name;
  std::function<Cloud(std::uint64_t seed)> make;
  double sigma;
  std::function<double(const Eigen::RowVector3d&)> distance;  ///< to the surface
  int eigenvalues = 29;
};

double toCube(const Eigen::RowVector3d& x) {
  const Eigen::Array3d out = (x.transpose().array() - 0.5).abs() - 0.5;
  return std::min(0.0, out.maxCoeff()) + out.max(0.0).matrix().norm();
}

std::vector<NoisyShape> noisyShapes() {
  const auto sphere = [](std::uint64_t seed) { return shapes::sphere(points, Sampling::uniform, seed); };
  const auto lines = [](std::uint64_t) { return shapes::sphere(points, Sampling::scanLines(20)); };
  const auto torus = [](std::uint64_t seed) { return shapes::torus(points, Sampling::uniform, seed); };
  const auto patch = [](std::uint64_t seed) {
    return shapes::cylinderPatch(points, Sampling::uniform, shapes::Rim::included, seed);
  };
  const auto cube = [](std::uint64_t seed) { return shapes::cubeSurface(points, seed); };
  const auto planes = [](std::uint64_t seed) { return shapes::crossingPlanes(points, seed); };
  const auto to_sphere = [](const Eigen::RowVector3d& x) { return x.norm() - 1; };
  const auto to_torus = [](const Eigen::RowVector3d& x) { return std::hypot(std::hypot(x[0], x[1]) - 1, x[2]) - 0.4; };
  const auto to_cylinder = [](const Eigen::RowVector3d& x) { return std::hypot(x[0], x[1]) - 1; };
  const auto to_planes = [](const Eigen::RowVector3d& x) { return std::min(std::abs(x[1]), std::abs(x[2])); };
  const double half_spacing = std::sqrt(std::numbers::pi / points);  // of the sphere
  std::vector<NoisyShape> shapes;
  for (const auto& [name, sigma] : {std::pair("sphere .25 %", 0.0025),
                                    {"sphere .5 %", 0.005},
                                    {"sphere 1 %", 0.01},
                                    {"sphere 2 %", 0.02},
                                    {"sphere 4 %", 0.04}})
    shapes.push_back({name, sphere, sigma, to_sphere});
  for (const auto& [name, sigma] : {std::pair("torus .25 %", 0.0025), {"torus 1 %", 0.01}, {"torus 2 %", 0.02}})
    shapes.push_back({name, torus, sigma, to_torus});
  shapes.push_back({"sphere, lines 1:20, half a spacing", lines, half_spacing, to_sphere, 32});
  shapes.push_back({"half cylinder 1 %", patch, 0.01, to_cylinder});
  shapes.push_back({"cube .25 %", cube, 0.0025, toCube});
  shapes.push_back({"cube 1 %", cube, 0.01, toCube});
  shapes.push_back({"crossing planes 1 %", planes, 0.01, to_planes});
  return shapes;
}

double rms(const Points& x, const NoisyShape& shape) {
  double sum = 0;
  for (int i = 0; i < x.rows(); ++i) sum += std::pow(shape.distance(x.row(i)), 2);
  return std::sqrt(sum / static_cast<double>(x.rows()));
}

double eigenvalueError(const Laplacian& laplacian, const Cloud& cloud, int count) {
  const VectorXd found = oracles::smallestEigenvalues(laplacian.L, laplacian.M, count + 1);
  return oracles::meanRelativeError(found, cloud.eigenvalues.head(count + 1));
}

}  // namespace

void printNoise() {
  std::printf(
      "\n| shape, noise | rms off the surface, spacings | after denoise | MLS, best radius | estimated / true noise | "
      "eigenvalue error | after denoise |\n|---|---|---|---|---|---|---|\n");
#ifdef TUFTED_BENCH_PCL
  const std::vector<double> radii = {3, 4, 6, 8, 10};  // in spacings
#else
  const std::vector<double> radii;
#endif
  for (const NoisyShape& shape : noisyShapes()) {
    double before = 0, after = 0, noise = 0, error_before = 0, error_after = 0, spacing = 0;
    std::vector<double> others(radii.size(), 0);
    for (std::uint64_t seed = first_seed; seed <= last_seed; ++seed) {
      const Cloud cloud = withNoise(shape.make(seed), shape.sigma, seed + 100);
      spacing = std::sqrt(cloud.area / static_cast<double>(cloud.points.rows()));
      const DenoisedPoints done = denoise(cloud.points);
      before += rms(cloud.points, shape) / spacing;
      after += rms(done.positions, shape) / spacing;
      noise += done.report.noise / shape.sigma;
      error_before += eigenvalueError(pointCloudLaplacian(cloud.points), cloud, shape.eigenvalues);
      error_after += eigenvalueError(pointCloudLaplacian(done.positions), cloud, shape.eigenvalues);
#ifdef TUFTED_BENCH_PCL
      for (std::size_t r = 0; r < radii.size(); ++r)
        others[r] += rms(movedByLeastSquares(cloud.points, radii[r] * spacing, 2), shape) / spacing;
#endif
    }
    constexpr double seeds = last_seed - first_seed + 1;
    std::printf("| %s | %.3f | %.3f | ", shape.name.c_str(), before / seeds, after / seeds);
    if (const auto best = std::min_element(others.begin(), others.end()); best != others.end())
      std::printf("%.3f (%g)", *best / seeds, radii[static_cast<std::size_t>(best - others.begin())]);
    std::printf(" | %.2f | %.1e | %.1e |\n", noise / seeds, error_before / seeds, error_after / seeds);
    std::fflush(stdout);
  }
}

}  // namespace tufted::bench
