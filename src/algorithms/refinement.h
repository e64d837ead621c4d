#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "algorithms/linear_system.h"
#include "algorithms/nearly_disconnected.h"
#include "algorithms/pinned_system.h"

namespace tufted {

/// The row of b - A u at a point; u is without the mean of the component's pins, so that its digits are those of their
/// differences.
using Missing = std::function<Eigen::RowVectorXd(const Eigen::MatrixXd& u, int point)>;

/// Solves a pinned system again and again for what is missing until nothing is. Far more accurate than one solve, as
/// what is missing comes from differences of neighbours.
class Refinement {
 public:
  /// @param right N x c; b
  /// @param promised part of the range that the last correction may be; above it digits are wrong
  Refinement(const SystemNames& names, const PinnedSystem& pinned, Missing missing, const Eigen::MatrixXd& right,
             double promised, const SolverOptions& options);

  /// Has constants on badly joined parts without a pin found by themselves; only if the matrix is L.
  void separateParts(const Laplacian& laplacian);

  /// Solves the system and corrects the solution.
  /// @param A its rows and columns of free points make the system
  /// @param made gets all but the seconds
  Eigen::MatrixXd run(const SparseMatrix& A, SolveReport& made);

 private:
  /// Measures what is missing of the solution.
  /// @param first norms of what was missing at first
  void measure(const SparseMatrix& A, const Eigen::RowVectorXd& first, SolveReport& made) const;
  /// What is missing at the free points, in components and columns where `wanted` is 1.
  Eigen::MatrixXd missing(const Eigen::MatrixXd& u, const Eigen::MatrixXd& wanted) const;
  /// Adds a correction where it is less than half of the last one; otherwise only rounding is left.
  /// @param is_last whether no other correction follows
  void add(const Eigen::MatrixXd& step, bool is_last);
  /// The free points.
  std::vector<int> freePoints() const;
  std::string advice() const;
  [[noreturn]] void fail(const std::string& what) const;

  const SystemNames& names_;
  const PinnedSystem& pinned_;
  Missing missing_;
  const Eigen::MatrixXd& right_;
  double promised_;
  SolverOptions options_;
  std::vector<std::uint8_t> in_factor_;  ///< N; the free points but the first of each floating part
  Components parts_;                     ///< empty if no part is joined badly
  std::vector<std::uint8_t> floating_;   ///< by part; 1: no pin is there
  SparseMatrix L_;                       ///< with parts, without weights between components
  bool is_iterative_ = false;
  Eigen::MatrixXd u_;     ///< N x c, without the means
  Eigen::MatrixXd open_;  ///< components x c; 1 where corrections go on
  Eigen::MatrixXd last_;  ///< components x c; the largest value of the last correction
};

}  // namespace tufted
