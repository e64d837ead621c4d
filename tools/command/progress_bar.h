#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

#include "tufted/options.h"

/// A line on stderr that is overwritten as work proceeds: the stage, the fraction that is done, the rate, and the time
/// left. Shows nothing if stderr is not a terminal.
class ProgressBar {
 public:
  /// @param is_quiet whether to show nothing
  explicit ProgressBar(bool is_quiet);
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// @param fraction of the stage that is done, in [0, 1]
  void show(std::string_view stage, double fraction);
  /// Sets how many points the next stages process, for the rate; 0: no rate is shown.
  void setPoints(std::int64_t points) { points_ = points; }
  /// Removes the line.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  bool terminal_;
  bool shown_ = false;
  std::string stage_;
  std::int64_t points_ = 0;
  double fraction_ = 0;
  Clock::time_point last_ = {}, stage_start_ = {};
};

/// Shows progress on the bar, which is borrowed, and cancels after Ctrl-C.
tufted::Progress showOn(ProgressBar& bar);
