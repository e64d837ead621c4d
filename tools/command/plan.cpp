#include "plan.h"

#include <algorithm>

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
