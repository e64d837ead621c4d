#include "expected_cost.h"

#include <Eigen/Core>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <thread>

#include "tufted/laplacian.h"
#include "tufted/scan_structure.h"

namespace {

// By fourteen clouds of 8,600 to five million points: scans, depth images, exact and noisy shapes, text and binary.
constexpr double seconds_of_program = 0.02;   ///< of a process that builds a few points
constexpr double seconds_of_files = 6e-7;     ///< reading and writing take 0.4 to 0.9 us per point
constexpr double bytes_of_program = 2e7;      ///< of a process that builds a few points
constexpr double peak_per_stages = 0.9;       ///< peak memory of a build by the bytes of all stages, 0.75 to 1.05
constexpr double least_efficiency = 0.8;      ///< of threads: two are 1.6 to 1.9 times as fast as one
constexpr double growth_per_doubling = 0.05;  ///< caches help less: time per point of a million points is 1.2 times
                                              ///< that of 100,000

/// Number of finite points. Missing pixels of a depth image cost next to nothing.
double countFinite(const tufted::PointsRef& points) {
  double count = 0;
  for (Eigen::Index i = 0; i < points.rows(); ++i) count += points.row(i).allFinite() ? 1 : 0;
  return count;
}

}  // namespace

std::vector<int> fullestRows(const tufted::Geometry& geometry, int most) {
  const int rows = std::clamp(most / geometry.width, 1, geometry.height);
  // Blocks that overlap by half are compared. Of blocks with equal counts the nearest to the middle is taken.
  const int step = std::max(1, rows / 2), middle = (geometry.height - rows) / 2;
  int best = middle;
  double most_finite = countFinite(geometry.points.middleRows(middle * geometry.width, rows * geometry.width));
  for (int first = middle % step; first + rows <= geometry.height; first += step) {
    const double finite = countFinite(geometry.points.middleRows(first * geometry.width, rows * geometry.width));
    if (finite < most_finite || (finite == most_finite && std::abs(first - middle) >= std::abs(best - middle)))
      continue;
    most_finite = finite;
    best = first;
  }
  std::vector<int> sample(static_cast<std::size_t>(rows) * geometry.width);
  std::iota(sample.begin(), sample.end(), best * geometry.width);
  return sample;
}

ExpectedCost expectedCost(const tufted::Geometry& geometry, std::int64_t finite, const std::vector<int>& sample,
                          Structure structure, tufted::CloudOptions options) {
  const tufted::Points points = geometry.points(sample, Eigen::all);
  const double all = static_cast<double>(geometry.points.rows());
  const double finite_in_sample = countFinite(points);
  if (finite_in_sample == 0) return withFiles(0, 0, all);
  std::optional<tufted::ScanStructure> image;
  if (structure == Structure::image) {
    image = tufted::imageStructure(geometry.width, static_cast<int>(points.rows()) / geometry.width,
                                   {geometry.viewpoint[0], geometry.viewpoint[1], geometry.viewpoint[2]});
    options.structure = &*image;
  }
  options.keep_cover = false;
  const BuildWatch watch;
  const tufted::Laplacian built = tufted::pointCloudLaplacian(points, options);
  ExpectedCost cost = {.seconds = watch.seconds(options.threads)};
  for (const tufted::StageCost& stage : built.report.stages) cost.bytes += static_cast<double>(stage.bytes);
  const double ratio = static_cast<double>(finite) / finite_in_sample;
  cost.seconds *= ratio * (1 + growth_per_doubling * std::log2(ratio));
  return withFiles(cost.seconds, cost.bytes * ratio * peak_per_stages, all);
}

double BuildWatch::seconds(int threads) const {
  const std::chrono::duration<double> elapsed = Clock::now() - start_;
  const double busy = static_cast<double>(std::clock() - processor_start_) / CLOCKS_PER_SEC;
  const unsigned processors = std::max(1U, std::thread::hardware_concurrency());
  const double shared = threads > 0 ? std::min(processors, static_cast<unsigned>(threads)) : processors;
  return std::min(elapsed.count(), busy / (shared == 1 ? 1 : least_efficiency * shared));
}

ExpectedCost withFiles(double seconds, double bytes, double points) {
  return {seconds + seconds_of_program + seconds_of_files * points, bytes + bytes_of_program};
}
