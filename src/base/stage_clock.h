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
  /// Seconds so far, then starts again.
  double restart() {
    const auto now = Clock::now();
    return std::chrono::duration<double>(now - std::exchange(start_, now)).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

/// Writes the cost of one stage after the other into a report.
class StageClock {
 public:
  explicit StageClock(Report& report) : report_(report) {}
  /// Books the time since the last call under `stage`, with the bytes that the stage leaves behind.
  void finish(std::string stage, std::size_t bytes) {
    report_.stages.push_back({std::move(stage), watch_.restart(), bytes});
  }
  /// Time since the last call, for stages that are booked in parts.
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
