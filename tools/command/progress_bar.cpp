#include "progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "interrupt.h"

namespace {

/// A time as text: "48 s", "2 min 5 s".
std::string duration(double seconds) {
  const auto whole = std::lround(seconds);
  return whole < 60 ? std::to_string(whole) + " s"
                    : std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
}

}  // namespace

ProgressBar::ProgressBar(bool is_quiet) : terminal_(!is_quiet && isatty(STDERR_FILENO) != 0) {}

void ProgressBar::show(std::string_view stage, double fraction) {
  if (!terminal_) return;
  const bool is_known = plan_.isEmpty() || plan_.reach(stage, fraction);
  constexpr auto interval = std::chrono::milliseconds(100);
  const auto now = Clock::now();
  if (stage == stage_ && now - last_ < interval) return;
  last_ = now;
  if (stage != stage_ || fraction < fraction_) stage_start_ = now;
  fraction_ = fraction;
  stage_ = stage;
  shown_ = true;
  const double share = plan_.isEmpty() ? std::clamp(fraction, 0.0, 1.0) : plan_.share();
  constexpr int width = 30;
  const int done = static_cast<int>(share * width);
  const std::string bar = std::string(done, '#') + std::string(width - done, '.');
  const auto from = is_known && !plan_.isEmpty() ? start_ : stage_start_;
  const double elapsed = std::chrono::duration<double>(now - from).count();
  std::string pace;
  // An estimate made too early would jump, and a stage that is not in the plan may take any time.
  if (elapsed > 1 && is_known && share > 0.01 && share < 1)
    pace = ", " + duration(elapsed * (1 - share) / share) + " left";
  else if (elapsed > 1)
    pace = ", " + duration(elapsed);
  // Returns to the first column, and erases the rest of a longer line.
  std::fprintf(stderr, "\r%s %3.0f %% %s%s\033[K", bar.c_str(), share * 100, stage_.c_str(), pace.c_str());
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
