#pragma once

#include <chrono>
#include <cstdint>
#include <ctime>
#include <vector>

#include "structure.h"
#include "tufted/io/read.h"
#include "tufted/options.h"

/// What `tufted laplacian FILE --out DIR` is expected to take.
struct ExpectedCost {
  double seconds = 0;
  double bytes = 0;  ///< peak memory
};

/// Time of a build, from the construction on, as if no other program ran: not more than its processor time by its
/// threads.
class BuildWatch {
 public:
  /// @param threads of the build, 0: one per processor
  double seconds(int threads) const;

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
  std::clock_t processor_start_ = std::clock();
};

/// The consecutive rows of an organized cloud, of about `most` pixels, that have the most finite points.
std::vector<int> fullestRows(const tufted::Geometry& geometry, int most);

/// Builds a sample of a cloud with the default options, and extrapolates from its cost to all points.
/// @param finite number of finite points of the cloud
/// @param sample indices as those of tufted::sampleRegions(), or fullestRows() for a depth image
/// @param structure of the build, none or image
/// @param options neighbours, threads and progress of the build
ExpectedCost expectedCost(const tufted::Geometry& geometry, std::int64_t finite, const std::vector<int>& sample,
                          Structure structure, tufted::CloudOptions options);

/// Adds the program, and the reading and writing of files, to the cost of a build.
/// @param seconds,bytes of the build
ExpectedCost withFiles(double seconds, double bytes, double points);
