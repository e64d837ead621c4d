#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "algorithms/linear_system.h"
#include "algorithms/nearly_disconnected.h"
#include "algorithms/pinned_system.h"

namespace tufted {

/// A pinned system, factored: what solves for any values of the pins have in common.
class PinnedSolver {
 public:
  /// @param A its rows and columns of free points make the system
  /// @param badly_joined the Laplacian, if A is its L: then constants on badly joined parts without a pin are found by
  /// themselves. Null otherwise.
  PinnedSolver(const SystemNames& names, PinnedPoints pinned, const SparseMatrix& A, const Laplacian* badly_joined,
               const SolverOptions& options);

  /// Solves for what is missing at the free points, N x c.
  /// @param function to be named in errors
  /// @param iterations those of this solve are added
  Eigen::MatrixXd solve(const std::string& function, const Eigen::MatrixXd& rest, const Progress& progress,
                        int& iterations) const;

  const PinnedPoints& pinned() const { return pinned_; }
  /// The free points, ascending.
  const std::vector<int>& freePoints() const { return free_points_; }
  const SolverReport& report() const { return system_->report(); }
  double tolerance() const { return tolerance_; }
  /// Iterations of the solves that made it.
  int iterations() const { return iterations_; }

 private:
  /// Solves with the first points of floating parts held at 0.
  Eigen::MatrixXd withinParts(const std::string& function, Eigen::MatrixXd rest, const Progress& progress,
                              int& iterations) const;

  PinnedPoints pinned_;
  std::vector<int> free_points_;
  std::vector<int> held_;                ///< active points outside of the factor
  SparseMatrix L_;                       ///< with parts, without weights between components
  std::optional<PartConstants> joints_;  ///< none if no part is joined badly
  std::optional<LinearSystem> system_;
  double tolerance_;
  int iterations_ = 0;
};

}  // namespace tufted
