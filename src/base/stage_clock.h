#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "tufted/report.h"

namespace tufted {

/// Seconds since construction or the last `restart`.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  /// Returns seconds() and starts again from 0.
  double restart() {
    const auto now = Clock::now();
    return std::chrono::duration<double>(now - std::exchange(start_, now)).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

/// Records the seconds and bytes of each stage of a build in a report.
class StageClock {
 public:
  explicit StageClock(Report& report) : report_(report) {}
  /// Appends `stage` to Report::stages with the time since the last call and the bytes of its results.
  void finish(std::string stage, std::size_t bytes) {
    report_.stages.push_back({std::move(stage), watch_.restart(), bytes});
  }
  /// seconds(), then starts again, for stages timed in parts.
  double restart() { return watch_.restart(); }

 private:
  Report& report_;
  Stopwatch watch_;
};

template <class T, class Allocator>
std::size_t bytesOf(const std::vector<T, Allocator>& values) {
  return values.capacity() * sizeof(T);
}

}  // namespace tufted
