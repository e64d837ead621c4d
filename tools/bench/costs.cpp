#include "bench/costs.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>

namespace tufted::bench {
namespace {

double peakBytes(const rusage& usage) {
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

}  // namespace

void Costs::measurePeak(const std::function<void()>& build) {
  const pid_t child = fork();
  if (child == 0) {
    try {
      build();
    } catch (...) {
      _exit(1);
    }
    _exit(0);
  }
  int status = 0;
  rusage usage{};
  if (child < 0 || wait4(child, &status, 0, &usage) != child || status != 0)
    throw std::runtime_error("the build whose peak was asked for has failed");
  peak_bytes_ = peakBytes(usage);
}

void Costs::addBuild(double seconds, const Report& report) {
  addSeconds("whole", seconds);
  for (const StageCost& stage : report.stages) {
    addSeconds(stage.name, stage.seconds);
    bytes_[stage.name] = stage.bytes;
  }
}

double Costs::medianSeconds(const std::string& name) const {
  std::vector<double> values = seconds_.at(name);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

void Costs::publish(benchmark::State& state) const {
  const auto items = static_cast<double>(items_);
  for (const auto& [name, values] : seconds_) state.counters["s:" + name] = medianSeconds(name);
  double sum = 0;
  for (const auto& [name, bytes] : bytes_) {
    sum += static_cast<double>(bytes);
    if (bytes > 0) state.counters["B:" + name] = static_cast<double>(bytes);
  }
  state.counters["B_per_item"] = sum / items;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["peak_B_per_item"] = (peak_bytes_ > 0 ? peak_bytes_ : peakBytes(usage)) / items;
  state.counters["us_per_item"] = 1e6 * medianSeconds("whole") / items;
}

benchmark::IterationCount iterationsFor(std::int64_t items) {
  return std::clamp<benchmark::IterationCount>(2'000'000 / items, 3, 20);
}

std::string threadsName(int threads) {
  return "threads:" + (threads > 0 ? std::to_string(threads) : "all");
}

}  // namespace tufted::bench
