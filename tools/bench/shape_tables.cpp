#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "bench/cotan_weights.h"
#include "bench/pcl_rivals.h"
#include "bench/real_shapes.h"
#include "bench/tables.h"
#include "oracles/oracles.h"
#include "shapes/random.h"
#include "shapes/shapes.h"
#include "tufted/errors.h"
#include "tufted/interpolation.h"
#include "tufted/io/read.h"
#include "tufted/minimal_surface.h"
#include "tufted/parameterization.h"
#include "tufted/smoothing.h"
#include "tufted/surface_triangles.h"
#include "tufted/weights.h"

namespace tufted::bench {
namespace {

Points halfSphere(int n, std::uint64_t seed) {
  const Points whole = shapes::sphere(2 * n, shapes::Sampling::uniform, seed).points;
  std::vector<int> upper;
  for (int i = 0; i < whole.rows(); ++i)
    if (whole(i, 2) >= 0) upper.push_back(i);
  return whole(upper, Eigen::all);
}

/// Prints mean and greatest quasi-conformal error over the seeds, and the number of flipped triangles.
void printMap(const char* name, bool is_clean, const std::function<Points(std::uint64_t)>& sample) {
  double sum = 0, greatest = 0;
  long long flipped = 0, triangles = 0;
  for (std::uint64_t seed = first_seed; seed <= last_seed; ++seed) {
    const Laplacian laplacian =
        pointCloudLaplacian(sample(seed), cloudOptions(is_clean ? Preset::clean : Preset::scan));
    ParameterizationReport report;
    parameterize(laplacian, surfaceTriangles(laplacian), {}, &report);
    sum += report.quasi_conformal_error;
    greatest = std::max(greatest, report.quasi_conformal_error);
    flipped += report.flipped, triangles += report.triangles;
  }
  std::printf("| %s, `%s` | %.4f / %.4f | %lld of %lld |\n", name, is_clean ? "clean" : "scan",
              sum / static_cast<double>(last_seed - first_seed + 1), greatest, flipped, triangles);
}

/// A tube between rings of radius 1 at z = -0.5 and 0.5, pinched and dented, with uneven triangles.
struct Tube {
  Points points;
  Triangles triangles;
};
Tube tube(double unevenness, std::uint64_t seed) {
  constexpr int around = 60, along = 24;
  shapes::Random random(seed);
  Tube made;
  made.points.resize(around * (along + 1), 3);
  for (int j = 0; j <= along; ++j) {
    const bool is_rim = j == 0 || j == along;
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * M_PI * (i + (is_rim ? 0 : unevenness * (random.uniform() - 0.5))) / around;
      const double z = (j + (is_rim ? 0 : unevenness * (random.uniform() - 0.5))) / along - 0.5;
      const double radius = is_rim ? 1 : (1 - 0.5 * std::cos(M_PI * z)) * (1 + 0.2 * std::sin(3 * angle + 5 * z));
      made.points.row(Eigen::Index{j} * around + i) << radius * std::cos(angle), radius * std::sin(angle), z;
    }
  }
  made.triangles.resize(2 * around * along, 3);
  for (int j = 0, t = 0; j < along; ++j)
    for (int i = 0; i < around; ++i) {
      const int a = j * around + i, b = j * around + (i + 1) % around;
      made.triangles.row(t++) << a, b, b + around;
      made.triangles.row(t++) << a, b + around, a + around;
    }
  return made;
}

/// The greatest relative error of the radius of the catenoid between these rings.
double catenoidError(const Points& points) {
  double c = 0.85;
  for (int k = 0; k < 50; ++k) c -= (c * std::cosh(0.5 / c) - 1) / (std::cosh(0.5 / c) - 0.5 / c * std::sinh(0.5 / c));
  double greatest = 0;
  for (const auto& p : points.rowwise()) {
    const double radius = c * std::cosh(std::clamp(p.z(), -0.5, 0.5) / c);
    const double error = std::abs(p.head<2>().norm() / radius - 1);
    greatest = std::max(greatest, std::isfinite(error) ? error : HUGE_VAL);
  }
  return greatest;
}

/// The iteration of minimalSurface() with the cotan matrix of the triangles.
Points minimalByCotan(const Tube& start, int iterations) {
  Points x = start.points;
  std::vector<int> rim;
  for (int i = 0; i < x.rows(); ++i)
    if (i < 60 || i >= x.rows() - 60) rim.push_back(i);
  for (int k = 0; k < iterations; ++k) {
    Laplacian laplacian = meshLaplacian(x, start.triangles);
    laplacian.L = oracles::cotanLaplacian(x, start.triangles).L;
    x = harmonic(laplacian, {rim, x(rim, Eigen::all)});
  }
  return x;
}

Points noisySphere(std::uint64_t seed) {
  return shapes::withNoise(shapes::sphere(16000, shapes::Sampling::uniform, seed), 0.01, seed).points;
}

/// Root mean square distance from the unit sphere.
double fromSphere(const Points& points) {
  return std::sqrt((points.rowwise().norm().array() - 1).square().mean());
}

/// The mean cubed radius, the volume relative to that of the unit sphere.
double volumeShare(const Points& points) {
  return points.rowwise().norm().array().cube().mean();
}

}  // namespace

void printMaps() {
  std::printf("| conformal map | quasi-conformal error, mean / greatest of 5 | flipped |\n|---|---|---|\n");
  for (const bool is_clean : {true, false}) {
    printMap("disk, 4,000 points", is_clean, [](std::uint64_t seed) {
      return shapes::disk(4000, shapes::Sampling::uniform, shapes::Rim::none, seed).points;
    });
    printMap("half sphere, 4,000", is_clean, [](std::uint64_t seed) { return halfSphere(4000, seed); });
    printMap("half sphere, 16,000", is_clean, [](std::uint64_t seed) { return halfSphere(16000, seed); });
  }
}

void printDisks() {
  std::printf("| mesh | triangles | weights of `L`: flipped | cotan | mean values |\n|---|---|---|---|---|\n");
  long long sums[3] = {0, 0, 0};
  int meshes = 0;
  for (const auto& file : filesIn({TUFTED_CGAL_DATA_DIR "/meshes"})) {
    try {
      const Geometry geometry = read(file);
      if (geometry.triangles.rows() < 20 || geometry.triangles.rows() > 100000) continue;
      const auto flips = [&](const Laplacian& laplacian, HarmonicWeights weights) -> std::string {
        ParameterizationReport report;
        parameterize(laplacian, geometry.triangles, {.method = ParameterizationMethod::harmonic, .weights = weights},
                     &report);
        sums[weights == HarmonicWeights::mean_value ? 2 : 0] += report.flipped;
        return std::to_string(report.flipped);
      };
      Laplacian laplacian = meshLaplacian(geometry.points, geometry.triangles);
      const std::string ours = flips(laplacian, HarmonicWeights::laplacian),
                        mean = flips(laplacian, HarmonicWeights::mean_value);
      laplacian.L = oracles::cotanLaplacian(geometry.points, geometry.triangles).L;
      std::string cotan = "fails";
      const long long before = sums[0];
      try {
        cotan = flips(laplacian, HarmonicWeights::laplacian);
      } catch (const std::exception&) {
      }
      sums[1] += sums[0] - before;
      sums[0] = before;
      ++meshes;
      std::printf("| %s | %lld | %s | %s | %s |\n", file.filename().c_str(),
                  static_cast<long long>(geometry.triangles.rows()), ours.c_str(), cotan.c_str(), mean.c_str());
    } catch (const std::exception&) {
      continue;  // not a mesh, or no disk
    }
  }
  std::printf("| all %d | | %lld | %lld | %lld |\n", meshes, sums[0], sums[1], sums[2]);
}

void printMinimal() {
  std::printf(
      "| catenoid from a pinched tube | greatest error of the radius, %% | iterations | cotan, as many |\n"
      "|---|---|---|---|\n");
  for (const double unevenness : {0.0, 0.5, 0.9}) {
    double error = 0, cotan = 0;
    int iterations = 0;
    for (std::uint64_t seed = first_seed; seed <= last_seed; ++seed) {
      const Tube start = tube(unevenness, seed);
      const Laplacian laplacian = meshLaplacian(start.points, start.triangles);
      MinimalSurfaceReport report;
      error = std::max(error, catenoidError(minimalSurface(laplacian, start.triangles, {}, &report)));
      iterations = std::max(iterations, report.iterations);
      try {
        cotan = std::max(cotan, catenoidError(minimalByCotan(start, report.iterations)));
      } catch (const std::exception&) {
        cotan = HUGE_VAL;
      }
    }
    std::printf("| points moved by up to %g of a step | %.2f | %d | %.2f |\n", unevenness / 2, 100 * error, iterations,
                100 * cotan);
  }
}

void printSmoothing() {
  std::printf(
      "| sphere, 16,000 points, noise 1 %% | distance to the sphere, before over after | volume, %% |\n"
      "|---|---|---|\n");
  struct Way {
    const char* name;
    SmoothingOptions options;
    bool keep_volume;
  };
  const std::vector<Way> ways = {{"implicit, time step 20", {.time_step = 20}, false},
                                 {"implicit, time step 20, volume kept", {.time_step = 20}, true},
                                 {"implicit, 5 steps of 8, volume kept", {.time_step = 8, .iterations = 5}, true},
                                 {"Taubin, 20 steps", {.method = SmoothingMethod::taubin, .iterations = 20}, false},
                                 {"Taubin, 100 steps", {.method = SmoothingMethod::taubin, .iterations = 100}, false}};
  for (const Way& way : ways) {
    double least = HUGE_VAL, worst = 0;
    for (std::uint64_t seed = first_seed; seed <= last_seed; ++seed) {
      const Points points = noisySphere(seed);
      const Laplacian laplacian = pointCloudLaplacian(points);
      const Triangles triangles = surfaceTriangles(laplacian);
      SmoothingOptions options = way.options;
      if (way.keep_volume) options.volume_of = &triangles;
      const Points smoothed = smooth(laplacian, points, options);
      least = std::min(least, fromSphere(points) / fromSphere(smoothed));
      const double off = volumeShare(smoothed) / volumeShare(points) - 1;
      if (std::abs(off) > std::abs(worst)) worst = off;
    }
    std::printf("| %s | %.1f | %+.2f |\n", way.name, least, 100 * worst);
  }
#ifdef TUFTED_BENCH_PCL
  for (const double radius : {0.06, 0.1, 0.15, 0.2, 0.3, 0.4, 0.6}) {
    double least = HUGE_VAL, worst = 0;
    for (std::uint64_t seed = first_seed; seed <= last_seed; ++seed) {
      const Points points = noisySphere(seed), moved = movedByLeastSquares(points, radius, 2);
      least = std::min(least, fromSphere(points) / fromSphere(moved));
      const double off = volumeShare(moved) / volumeShare(points) - 1;
      if (std::abs(off) > std::abs(worst)) worst = off;
    }
    std::printf("| pcl::MovingLeastSquares, radius %g, order 2 | %.1f | %+.2f |\n", radius, least, 100 * worst);
  }
#endif
}

void printWeights() {
  std::printf(
      "| four handles | systems | residual | from good triangles, farthest | cotan, the same |\n"
      "|---|---|---|---|---|\n");
  for (const bool is_prism : {false, true}) {
    const auto solid = [&](shapes::Quality quality) {
      return is_prism ? shapes::prismMesh(10, quality, first_seed) : shapes::cubeMesh(10, quality, first_seed);
    };
    const shapes::Mesh good = solid(shapes::Quality::good), bad = solid(shapes::Quality::bad);
    const auto n = static_cast<int>(good.points.rows());
    const std::vector<std::vector<int>> handles = {{0}, {n / 3}, {n / 2}, {n - 1}};
    const Eigen::MatrixXd reference = boundedBiharmonicWeights(meshLaplacian(good.points, good.triangles), handles);
    const Laplacian laplacian = meshLaplacian(bad.points, bad.triangles);
    WeightReport report;
    const Eigen::MatrixXd weights = boundedBiharmonicWeights(laplacian, handles, {}, &report);
    const Laplacian cotan = withCotan(laplacian, bad.points, bad.triangles);
    double other = HUGE_VAL;
    try {
      other = (boundedBiharmonicWeights(cotan, handles) - reference).cwiseAbs().maxCoeff();
    } catch (const std::exception&) {
    }
    std::printf("| %s | %d | %.1e | %.1e | %.2g |\n", bad.name.c_str(), report.iterations, report.residual,
                (weights - reference).cwiseAbs().maxCoeff(), other);
  }
}

}  // namespace tufted::bench
