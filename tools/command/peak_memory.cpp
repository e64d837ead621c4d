#include "peak_memory.h"

#include <sys/resource.h>

#include <fstream>
#include <string>

double peakMemory() {
  constexpr double kilobytes = 1024;  // per MB
  // Not by getrusage(), whose peak includes that of the process that called exec().
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double peak = 0;
    if (word == "VmHWM:" && status >> peak) return peak / kilobytes;
  }
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / kilobytes;
}
