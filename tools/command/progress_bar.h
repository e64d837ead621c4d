#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tufted/io/read.h"
#include "tufted/options.h"

/// A stage that a command is expected to come to.
struct PlannedStage {
  std::string_view name;
  double cost;   ///< time, of which the whole build of a noisy cloud takes 100
  int runs = 1;  ///< how often the stage starts again at 0
};
using PlannedStages = std::vector<PlannedStage>;

/// The stages of a build.
PlannedStages buildStages(const tufted::Geometry& geometry);
/// The stages that move the points of a noisy cloud.
PlannedStages denoiseStages(const tufted::Geometry& geometry);
/// The stages that describe the points of a cloud.
PlannedStages describeStages();
/// First these stages, then more.
PlannedStages operator+(PlannedStages first, const PlannedStages& more);
/// The stages of commands that solve linear systems.
PlannedStages solvingStages();
/// The stages of commands that compute `count` eigenpairs.
PlannedStages spectralStages(int count);

/// The stages of a command in their order, by which it is known how much of the command is done.
class Plan {
 public:
  /// A plan of nothing.
  Plan() = default;
  /// Reading, which is done, then the given stages, then writing.
  explicit Plan(const PlannedStages& stages);
  /// Reading, which is done, a build, then the command's own stages, then writing.
  Plan(const tufted::Geometry& geometry, const PlannedStages& own);

  bool isEmpty() const { return stages_.empty(); }
  /// Notes that a stage is done up to `fraction`. Stages before it that did not come are dropped from the plan.
  /// @return false for a stage that is not planned
  bool reach(std::string_view stage, double fraction);
  /// The share of all stages that is done. It never falls.
  double share() const { return share_; }

 private:
  PlannedStages stages_;
  std::size_t at_ = 0;
  int run_ = 0;
  double fraction_ = 0, done_ = 0, all_ = 0, share_ = 0;
};

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
