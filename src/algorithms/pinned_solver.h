#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "algorithms/linear_system.h"
#include "algorithms/nearly_disconnected.h"
#include "algorithms/pinned_system.h"

namespace tufted {

/// A factored system for one set of pinned points, reused for any values of the pins.
class PinnedSolver {
 public:
  /// @param A N x N; its rows and columns of free points are the system
  /// @param badly_joined the Laplacian if A is its L, to solve separately for parts without a pin that are joined by
  /// tiny weights only; null otherwise
  PinnedSolver(const SystemNames& names, PinnedPoints pinned, const SparseMatrix& A, const Laplacian* badly_joined,
               const SolverOptions& options);

  /// Solves A x = rest at the free points, N x c; x is 0 at the others.
  /// @param function named in errors
  /// @param iterations increased by those of this solve
  Eigen::MatrixXd solve(const std::string& function, const Eigen::MatrixXd& rest, const Progress& progress,
                        int& iterations) const;

  const PinnedPoints& pinned() const { return pinned_; }
  /// The free points, ascending.
  const std::vector<int>& freePoints() const { return free_points_; }
  const SolverReport& report() const { return system_->report(); }
  double tolerance() const { return tolerance_; }
  /// Iterations of the solves in the constructor.
  int iterations() const { return iterations_; }

 private:
  /// Solves with the first point of each floating part held at 0.
  Eigen::MatrixXd withinParts(const std::string& function, Eigen::MatrixXd rest, const Progress& progress,
                              int& iterations) const;

  PinnedPoints pinned_;
  std::vector<int> free_points_;
  std::vector<int> held_;                ///< active points that are not in the factor
  SparseMatrix L_;                       ///< if `joints_` is set: L without weights between components
  std::optional<PartConstants> joints_;  ///< not set if no part is joined by tiny weights only
  std::optional<LinearSystem> system_;
  double tolerance_;
  int iterations_ = 0;
};

}  // namespace tufted
