#pragma once

#include <malloc.h>

#include <cstdint>
#include <fstream>
#include <optional>
#include <string>

/// Whether the address sanitizer is at work, which takes several times the memory and the time.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool is_sanitized = true;
#elif defined(__has_feature)
constexpr bool is_sanitized = __has_feature(address_sanitizer);
#else
constexpr bool is_sanitized = false;
#endif

/// How much more memory this process holds at most, from here on. Counts what was written to, whoever asked for it.
class MemoryPeak {
 public:
  MemoryPeak() {
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << "5";  // the peak begins anew
    start_ = kilobytes("VmRSS:");
    const auto peak = kilobytes("VmHWM:");
    if (!peak || !start_ || *peak > *start_ + 10'000) start_.reset();
  }

  /// Nothing where the system does not tell.
  std::optional<std::int64_t> bytes() const {
    const auto peak = kilobytes("VmHWM:");
    if (!start_ || !peak) return std::nullopt;
    return (*peak - *start_) * 1024;
  }

 private:
  static std::optional<std::int64_t> kilobytes(const std::string& name) {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
      std::int64_t number = 0;
      if (word == name && status >> number) return number;
    }
    return std::nullopt;
  }

  std::optional<std::int64_t> start_;
};
