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

/// A rate as text: "1.3 M points/s", "520 k points/s".
std::string rate(double points_per_second) {
  char text[32];
  const bool is_large = points_per_second >= 1e6;
  std::snprintf(text, sizeof text, "%.3g %s points/s", points_per_second / (is_large ? 1e6 : 1e3),
                is_large ? "M" : "k");
  return text;
}

}  // namespace

ProgressBar::ProgressBar(bool is_quiet) : terminal_(!is_quiet && isatty(STDERR_FILENO) != 0) {}

void ProgressBar::show(std::string_view stage, double fraction) {
  if (!terminal_) return;
  constexpr auto interval = std::chrono::milliseconds(100);
  const auto now = Clock::now();
  if (stage == stage_ && now - last_ < interval) return;
  last_ = now;
  if (stage != stage_ || fraction < fraction_) stage_start_ = now;
  fraction_ = fraction;
  stage_ = stage;
  shown_ = true;
  constexpr int width = 30;
  const int done = std::clamp(static_cast<int>(fraction * width), 0, width);
  const std::string bar = std::string(done, '#') + std::string(width - done, '.');
  const double elapsed = std::chrono::duration<double>(now - stage_start_).count();
  std::string pace;
  if (points_ > 0 && fraction > 0 && elapsed > 0.1)
    pace += ", " + rate(fraction * static_cast<double>(points_) / elapsed);
  // An estimate made too early would jump.
  if (elapsed > 1 && fraction > 0.01 && fraction < 1)
    pace += ", " + duration(elapsed * (1 - fraction) / fraction) + " left";
  else if (elapsed > 1)
    pace += ", " + duration(elapsed);
  // Returns to the first column, and erases the rest of a longer line.
  std::fprintf(stderr, "\r%s %3.0f %% %s%s\033[K", bar.c_str(), std::clamp(fraction, 0.0, 1.0) * 100, stage_.c_str(),
               pace.c_str());
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
