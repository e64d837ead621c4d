#pragma once

#include <cstdint>
#include <vector>

#include "algorithms/bending.h"
#include "algorithms/connected.h"
#include "algorithms/linear_system.h"
#include "tufted/weights.h"

namespace tufted {

/// Minimises u^T L M^-1 L u over functions within [0, 1] with some given values: an interior point method guesses which
/// weights lie at a bound, then wrong ones are exchanged (docs/algorithm.md, section 19).
class BoundedProblem {
 public:
  /// A free weight outside [0, 1] by more than this is put on the bound; by less, it stays free.
  static constexpr double allowed = 1e-9;

  /// The Laplacian, its components and the options are borrowed.
  BoundedProblem(const Laplacian& laplacian, const Components& components, const WeightOptions& options)
      : L_(laplacian.L),
        options_(options),
        points_(components.points),
        inverse_(inverseMasses(laplacian, components)),
        Q_(bendingMatrix(L_, inverse_)),
        diagonal_(Q_.diagonal()) {}

  /// Solves for one function.
  /// @param is_free N; 1 at the points that may change
  /// @param[in,out] u N; on entry the values at the other points, on return the solution
  /// @param[in,out] residual raised to WeightReport::residual of this function
  /// @return systems solved
  int solve(const std::vector<std::uint8_t>& is_free, const Progress& progress, VectorXd& u, double& residual) const;

 private:
  enum class State : std::uint8_t { fixed, free, lower, upper };

  /// (Q u)_i / Q_ii from differences: how far each weight lies above its optimum while all others stay.
  VectorXd pull(const VectorXd& u) const;
  /// Factors the rows and columns of Q of free points, plus a diagonal.
  /// @param added N, added to the diagonal; size 0: nothing
  LinearSystem factor(const std::vector<State>& state, const VectorXd& added, const Progress& progress) const;
  /// Guesses which points lie at a bound, by Mehrotra's interior point method.
  /// @param[in,out] state free points become lower or upper ones
  /// @return systems solved
  int guess(const Progress& progress, VectorXd u, std::vector<State>& state) const;
  void solveFree(const std::vector<State>& state, const Progress& progress, VectorXd& u) const;
  State wanted(State state, double value, double pulled) const;

  const SparseMatrix& L_;
  const WeightOptions& options_;
  const std::vector<int>& points_;
  VectorXd inverse_;   ///< N; see inverseMasses()
  SparseMatrix Q_;     ///< L M^-1 L, in 1 / mean mass
  VectorXd diagonal_;  ///< N; the diagonal of Q_
};

}  // namespace tufted
