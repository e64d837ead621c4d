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

namespace {

// Costs are CPU times per point, measured with the progress callback and one thread on scans of 34,000 to 300,000
// points and on meshes of 170,000 vertices.

/// The stages of a cloud's build after those of denoiseStages().
PlannedStages cloudStages() {
  return {{"stars", 22},       {"outliers", 1, 4}, {"filter", 0.5, 2}, {"agreement", 1},
          {"diagonals", 1, 4}, {"votes", 0.5},     {"boundary", 4, 4}, {"glue", 1, 2},
          {"lengths", 1},      {"flips", 9, 4},    {"assemble", 7, 8}};
}

/// The stages of an image's build after those of denoiseStages().
PlannedStages imageStages() {
  return {{"stars", 21},      {"filter", 3, 2}, {"agreement", 2}, {"diagonals", 4, 4}, {"votes", 1},
          {"boundary", 4, 4}, {"glue", 2, 2},   {"lengths", 2},   {"flips", 15, 4},    {"assemble", 18, 8}};
}

/// Later stages take a ninth of their time on clouds, whose costs are kept, so those of the build are nine-fold.
PlannedStages meshStages() {
  return {{"scale", 9, 6}, {"glue", 2, 2}, {"lengths", 2, 3}, {"mollify", 1}, {"flips", 4, 2}, {"assemble", 10, 6}};
}

}  // namespace

PlannedStages operator+(PlannedStages first, const PlannedStages& more) {
  first.insert(first.end(), more.begin(), more.end());
  return first;
}

PlannedStages buildStages(const tufted::Geometry& geometry) {
  if (geometry.is_mesh) return meshStages();
  return denoiseStages(geometry) + (geometry.height > 1 ? imageStages() : cloudStages());
}

PlannedStages denoiseStages(const tufted::Geometry& geometry) {
  if (geometry.height > 1) return {{"order", 5, 12}, {"windows", 18, 8}};
  return {{"order", 3, 12}, {"tree", 1},          {"noise", 3, 3}, {"surface fits", 4}, {"pools", 0.5},
          {"noise", 4, 5},  {"surface fits", 23}, {"pools", 3},    {"noise", 11, 4}};
}

PlannedStages describeStages() {
  return {{"order", 3, 12}, {"tree", 1}, {"neighbours", 25}, {"outliers", 5}};
}

PlannedStages solvingStages() {
  return {{"analyse", 15}, {"factor", 33}, {"solve", 4, 2}};
}

PlannedStages spectralStages(int count) {
  return {{"analyse", 15}, {"factor", 33}, {"eigenpairs", 6.0 * count}, {"count", 57}, {"eigenpairs", 1.4 * count}};
}

Plan::Plan(const tufted::Geometry& geometry, const PlannedStages& own) : Plan(buildStages(geometry) + own) {}

Plan::Plan(const PlannedStages& stages) : stages_(PlannedStages{{"read", 2}} + stages + PlannedStages{{"write", 4}}) {
  for (const PlannedStage& stage : stages_) all_ += stage.cost;
}

bool Plan::reach(std::string_view stage, double fraction) {
  if (stage != stages_[at_].name) {
    const auto is_sought = [&](const PlannedStage& planned) { return planned.name == stage; };
    const auto begin = stages_.begin() + static_cast<std::ptrdiff_t>(at_);
    const auto next = std::find_if(begin, stages_.end(), is_sought);
    if (next == stages_.end()) return false;
    done_ += begin->cost;
    for (auto skipped = begin + 1; skipped != next; ++skipped) all_ -= skipped->cost;
    at_ = static_cast<std::size_t>(next - stages_.begin());
    run_ = 0;
  } else if (fraction < fraction_) {
    ++run_;
  }
  fraction_ = fraction;
  const PlannedStage& now = stages_[at_];
  const double part = (std::min(run_, now.runs - 1) + std::clamp(fraction, 0.0, 1.0)) / now.runs;
  share_ = std::max(share_, (done_ + part * now.cost) / all_);
  return true;
}
