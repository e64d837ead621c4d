#pragma once

#include <functional>
#include <string>

#include "algorithms/pinned_solver.h"

namespace tufted {

/// The row of b - A u at a point; u is without the mean of the component's pins, so that its digits are those of their
/// differences.
using Missing = std::function<Eigen::RowVectorXd(const Eigen::MatrixXd& u, int point)>;

/// Solves a pinned system again and again for what is missing until nothing is. Far more accurate than one solve, as
/// what is missing comes from differences of neighbours.
class Refinement {
 public:
  /// @param function to be named in errors
  /// @param right N x c; b
  /// @param promised part of the range that the last correction may be; above it digits are wrong
  Refinement(std::string function, const PinnedSolver& solver, const PinnedValues& given, Missing missing,
             const Eigen::MatrixXd& right, double promised);

  /// Solves the system and corrects the solution.
  /// @param A that of the solver
  /// @param made gets all but the seconds
  Eigen::MatrixXd run(const SparseMatrix& A, const Progress& progress, SolveReport& made);

 private:
  /// Measures what is missing of the solution.
  /// @param first norms of what was missing at first
  void measure(const SparseMatrix& A, const Eigen::RowVectorXd& first, SolveReport& made) const;
  /// What is missing at the free points, in components and columns where `wanted` is 1.
  Eigen::MatrixXd missing(const Eigen::MatrixXd& u, const Eigen::MatrixXd& wanted) const;
  /// Adds a correction where it is less than half of the last one; otherwise only rounding is left.
  /// @param is_last whether no other correction follows
  void add(const Eigen::MatrixXd& step, bool is_last);
  std::string advice() const;
  [[noreturn]] void fail(const std::string& what) const;

  std::string function_;
  const PinnedSolver& solver_;
  const PinnedPoints& pinned_;
  const PinnedValues& given_;
  Missing missing_;
  const Eigen::MatrixXd& right_;
  double promised_;
  Eigen::MatrixXd u_;     ///< N x c, without the means
  Eigen::MatrixXd open_;  ///< components x c; 1 where corrections go on
  Eigen::MatrixXd last_;  ///< components x c; the largest value of the last correction
};

}  // namespace tufted
