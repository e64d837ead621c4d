#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

#include "tufted/options.h"

/// One line on stderr that is written over and over: the stage, how much of it is done, how fast, and how long it will
/// still take. Nothing at all when stderr is not a terminal.
class ProgressBar {
 public:
  /// @param is_quiet shows nothing
  explicit ProgressBar(bool is_quiet);
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// @param fraction of the stage that is done, in [0, 1]
  void show(std::string_view stage, double fraction);
  /// How many points the stages that follow go through, whose rate is shown; 0: no rate.
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
