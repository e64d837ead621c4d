#include "progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "interrupt.h"

ProgressBar::ProgressBar() : terminal_(isatty(STDERR_FILENO) != 0) {}

void ProgressBar::show(std::string_view stage, double fraction) {
  if (!terminal_) return;
  constexpr auto interval = std::chrono::milliseconds(100);
  const auto now = Clock::now();
  if (stage == stage_ && now - last_ < interval) return;
  last_ = now;
  stage_ = stage;
  shown_ = true;
  constexpr int width = 30;
  const int done = std::clamp(static_cast<int>(fraction * width), 0, width);
  const std::string bar = std::string(done, '#') + std::string(width - done, '.');
  // Return to the first column, and erase what an earlier, longer stage left behind.
  std::fprintf(stderr, "\r%s %3.0f %% %s\033[K", bar.c_str(), std::clamp(fraction, 0.0, 1.0) * 100, stage_.c_str());
  std::fflush(stderr);
}

void ProgressBar::clear() {
  if (!shown_) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  shown_ = false;
}

tufted::Progress showOn(ProgressBar& bar) {
  return [&bar](std::string_view stage, double fraction) {
    bar.show(stage, fraction);
    return !interrupted();
  };
}
