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

/// The row of b - A u; u without the mean of the component's pins, so that its digits are those of their differences.
using Missing = std::function<Eigen::RowVectorXd(const Eigen::MatrixXd& u, int point)>;

/// A pinned system that is solved again for what is missing until nothing is. Far more accurate than one solve, as what
/// is missing comes from differences of neighbours.
class Refinement {
 public:
  /// @param right N x c; b
  /// @param promised part of the range that the last correction may be; above it digits are wrong
  Refinement(const SystemNames& names, const PinnedSystem& pinned, Missing missing, const Eigen::MatrixXd& right,
             double promised, const SolverOptions& options);

  /// Finds constants on badly joined parts without a pin by themselves: for L alone.
  void separateParts(const Laplacian& laplacian);

  /// @param A its rows and columns of free points make the system
  /// @param made gets all but the seconds
  Eigen::MatrixXd run(const SparseMatrix& A, SolveReport& made);

 private:
  /// What the solution leaves.
  /// @param first norms of what was missing at first
  void measure(const SparseMatrix& A, const Eigen::RowVectorXd& first, SolveReport& made) const;
  /// At the free points, of components and columns where `wanted` is 1.
  Eigen::MatrixXd missing(const Eigen::MatrixXd& u, const Eigen::MatrixXd& wanted) const;
  /// Adds a correction, where it is less than half of the last one: beyond that rounding is all that is left.
  /// @param is_last there will be no other
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
  Components parts_;                     ///< none: no part is joined badly
  std::vector<std::uint8_t> floating_;   ///< by part; 1: no pin is there
  SparseMatrix L_;                       ///< with parts, without weights between components
  bool is_iterative_ = false;
  Eigen::MatrixXd u_;     ///< N x c, without the means
  Eigen::MatrixXd open_;  ///< components x c; 1 where corrections go on
  Eigen::MatrixXd last_;  ///< the same; the largest of the last correction
};

}  // namespace tufted
