#pragma once

#include <cmath>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

namespace tufted {

/// Counts how often a promise of validate() is broken, and keeps the text of the first time.
class Promise {
 public:
  explicit Promise(const char* name) : name_(name) {}

  template <class... Words>
  void brokenBy(const Words&... words) {
    if (count_++ > 0) return;
    std::ostringstream text;
    (text << ... << words);
    first_ = text.str();
  }
  std::int64_t count() const { return count_; }
  void addTo(std::vector<std::string>& faults) const {
    if (count_ == 1) faults.push_back(std::string(name_) + ": " + first_);
    if (count_ > 1) faults.push_back(std::string(name_) + ": " + std::to_string(count_) + " times, first " + first_);
  }

 private:
  const char* name_;
  std::int64_t count_ = 0;
  std::string first_;
};

/// Raises `greatest` to `error`; NaN counts as infinite.
inline void raise(double& greatest, double error) {
  if (!(error <= greatest)) greatest = std::isnan(error) ? INFINITY : error;
}

}  // namespace tufted
