#pragma once

#include <functional>
#include <string>

#include "algorithms/pinned_solver.h"

namespace tufted {

/// Computes the row of b - A u at a point. The mean of the component's pins has been subtracted from u, so that its
/// digits are those of differences.
using Missing = std::function<Eigen::RowVectorXd(const Eigen::MatrixXd& u, int point)>;

/// Iterative refinement of a pinned system: solves for the residual b - A u until that is rounding. More accurate than
/// one solve, because the residual is computed from differences of neighbours.
class Refinement {
 public:
  /// @param function named in errors
  /// @param right N x c; b
  /// @param promised largest accepted last correction, as a part of the range of values
  Refinement(std::string function, const PinnedSolver& solver, const PinnedValues& given, Missing missing,
             const Eigen::MatrixXd& right, double promised);

  /// Solves the system and corrects the solution.
  /// @param A the matrix of the solver
  /// @param made gets all members except the seconds
  Eigen::MatrixXd run(const SparseMatrix& A, const Progress& progress, SolveReport& made);

 private:
  /// Measures residual and backward error; too large ones throw SolverFailure.
  /// @param first norms of the first residual, by column
  void measure(const SparseMatrix& A, const Eigen::RowVectorXd& first, SolveReport& made) const;
  /// The residual at the free points, in components and columns where `wanted` is 1.
  Eigen::MatrixXd missing(const Eigen::MatrixXd& u, const Eigen::MatrixXd& wanted) const;
  /// Adds a correction where it is less than half of the last one; elsewhere it is rounding.
  /// @param is_last whether no further correction follows
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
  Eigen::MatrixXd u_;     ///< N x c; the solution without the means of the pins
  Eigen::MatrixXd open_;  ///< components x c; 1 where more corrections follow
  Eigen::MatrixXd last_;  ///< components x c; largest magnitude of the last correction
};

}  // namespace tufted
