#pragma once

#include <benchmark/benchmark.h>

#include <cstdint>
#include <ctime>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "base/stage_clock.h"
#include "tufted/report.h"

namespace tufted::bench {

/// CPU time of this process, which depends little on other processes of the machine.
class CpuStopwatch {
 public:
  double seconds() const { return static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC; }

 private:
  std::clock_t start_ = std::clock();
};

/// Time of a build: CPU time on one thread, wall-clock time on several.
class BuildStopwatch {
 public:
  explicit BuildStopwatch(int threads) : threads_(threads) {}
  double seconds() const { return threads_ == 1 ? processor_.seconds() : clock_.seconds(); }

 private:
  int threads_;
  CpuStopwatch processor_;
  Stopwatch clock_;
};

/// Collects the costs of the builds of one case and writes medians as counters of the benchmark:
///   s:<stage>       seconds
///   B:<stage>       bytes that the stage leaves behind
///   B_per_item      sum of these per point (clouds) or triangle (meshes)
///   peak_B_per_item peak resident memory, per item, of the process of measurePeak(), otherwise of this one so far
class Costs {
 public:
  /// @param items points or triangles
  explicit Costs(std::int64_t items) : items_(items) {}

  /// Builds once on one thread, in a copy of this process.
  void measurePeak(const std::function<void()>& build);
  void addBuild(double seconds, const Report& report);
  /// Adds a measurement that is no stage of the build.
  void addSeconds(const std::string& name, double seconds) { seconds_[name].push_back(seconds); }

  /// Median of the times added as `name`; "whole" is the build.
  double medianSeconds(const std::string& name) const;

  void publish(benchmark::State& state) const;

 private:
  std::int64_t items_;
  std::map<std::string, std::vector<double>> seconds_;
  std::map<std::string, std::size_t> bytes_;
  double peak_bytes_ = 0;
};

/// Number of repetitions, fewer for larger cases.
benchmark::IterationCount iterationsFor(std::int64_t items);

std::string threadsName(int threads);

void registerClouds();
void registerMeshes();

}  // namespace tufted::bench
