#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "tufted/options.h"

/// One line on stderr that is written over and over, and nothing at all when stderr is not a terminal.
class ProgressBar {
 public:
  ProgressBar();
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// @param fraction of the stage that is done, in [0, 1]
  void show(std::string_view stage, double fraction);
  /// Removes the line.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  bool terminal_;
  bool shown_ = false;
  std::string stage_;
  Clock::time_point last_ = {};
};

/// Shows progress on the bar, which is borrowed, and cancels after Ctrl-C.
tufted::Progress showOn(ProgressBar& bar);
