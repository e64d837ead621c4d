#include "algorithms/pinned_solver.h"

#include <algorithm>
#include <utility>

#include "tufted/errors.h"

namespace tufted {
namespace {

/// The largest tolerance of conjugate gradients, so that few corrections are needed.
constexpr double correction_tolerance = 1e-10;

/// Parts of a Laplacian that are joined by tiny weights only.
struct BadlyJoined {
  Components parts;
  std::vector<std::uint8_t> floating;  ///< by part; 1 if it has no pin
};

/// Nullopt if there are no such parts.
std::optional<BadlyJoined> findBadlyJoined(const Laplacian& laplacian, const PinnedPoints& pinned) {
  BadlyJoined found{findParts(laplacian), {}};
  const Components& parts = found.parts;
  if (parts.count == pinned.components.count) return std::nullopt;
  found.floating.assign(parts.count, 0);
  for (const int i : parts.points) found.floating[parts.of[i]] |= pinned.free[i];
  for (const int i : parts.points)
    if (pinned.pinned[i] != 0) found.floating[parts.of[i]] = 0;
  return found;
}

}  // namespace

PinnedSolver::PinnedSolver(const SystemNames& names, PinnedPoints pinned, const SparseMatrix& A,
                           const Laplacian* badly_joined, const SolverOptions& options)
    : pinned_(std::move(pinned)), tolerance_(std::min(options.tolerance, correction_tolerance)) {
  std::vector<std::uint8_t> in_factor = pinned_.free;
  std::optional<BadlyJoined> joined;
  if (badly_joined != nullptr) joined = findBadlyJoined(*badly_joined, pinned_);
  if (joined) {
    std::vector<bool> begun(joined->parts.count, false);
    for (const int i : joined->parts.points) {
      const int part = joined->parts.of[i];
      if (joined->floating[part] == 0 || begun[part]) continue;
      in_factor[i] = 0;
      begun[part] = true;
    }
  }
  for (const int i : pinned_.components.points) {
    if (pinned_.free[i] != 0) free_points_.push_back(i);
    if (in_factor[i] == 0) held_.push_back(i);
  }
  SparseMatrix within = A;
  within.prune([&](Eigen::Index i, Eigen::Index j, double) { return in_factor[i] != 0 && in_factor[j] != 0; });
  SolverOptions tight = options;
  tight.tolerance = tolerance_;
  system_.emplace(LinearSystem::positiveDefinite(names, within, tight));
  if (!joined) return;
  const std::vector<int>& of = pinned_.components.of;
  L_ = badly_joined->L;
  L_.prune([&](Eigen::Index i, Eigen::Index j, double) { return of[i] == of[j]; });
  joints_.emplace(L_, free_points_, joined->parts, joined->floating, [&](const Eigen::MatrixXd& rest) {
    return withinParts(names.function, rest, options.progress, iterations_);
  });
  if (!joints_->isDefinite()) {
    throw SolverFailure(names.function + ": " + names.matrix + " is not positive semidefinite; " + names.if_indefinite);
  }
}

Eigen::MatrixXd PinnedSolver::withinParts(const std::string& function, Eigen::MatrixXd rest, const Progress& progress,
                                          int& iterations) const {
  if (rest.cols() == 0) return rest;  // no part is floating
  for (const int i : held_) rest.row(i).setZero();
  const Eigen::MatrixXd scale = pinned_.components.normalise(rest);
  SolveReport solved;
  Eigen::MatrixXd step = system_->solve(function, rest, &solved, progress, Refine::never);
  pinned_.components.multiply(step, scale);
  iterations += solved.iterations;
  return step;
}

Eigen::MatrixXd PinnedSolver::solve(const std::string& function, const Eigen::MatrixXd& rest, const Progress& progress,
                                    int& iterations) const {
  const auto inner = [&](const Eigen::MatrixXd& right) { return withinParts(function, right, progress, iterations); };
  return joints_ ? joints_->solve(L_, free_points_, rest, inner) : inner(rest);
}

}  // namespace tufted
