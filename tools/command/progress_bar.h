#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <utility>

#include "plan.h"
#include "tufted/options.h"

/// A line on stderr that is overwritten as work proceeds: the stage, the share that is done, and the time left: with a
/// plan of the whole command, otherwise of the stage. Shows nothing if stderr is not a terminal.
class ProgressBar {
 public:
  /// @param is_quiet whether to show nothing
  explicit ProgressBar(bool is_quiet);
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// @param fraction of the stage that is done, in [0, 1]
  void show(std::string_view stage, double fraction);
  /// Shows from now on how much of the whole command is done.
  void follow(Plan plan) { plan_ = std::move(plan); }
  /// Removes the line.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  bool terminal_;
  bool shown_ = false;
  std::string stage_;
  Plan plan_;
  double fraction_ = 0;
  Clock::time_point last_ = {}, start_ = Clock::now(), stage_start_ = {};
};

/// Shows progress on the bar, which is borrowed, and cancels after Ctrl-C.
tufted::Progress showOn(ProgressBar& bar);
