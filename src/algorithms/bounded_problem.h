#pragma once

#include <cstdint>
#include <vector>

#include "algorithms/bending.h"
#include "algorithms/connected.h"
#include "algorithms/linear_system.h"
#include "tufted/weights.h"

namespace tufted {

/// The least bending of one function within [0, 1].
class BoundedProblem {
 public:
  /// A free weight that leaves [0, 1] by more than this is put on the bound; by less, it stays free.
  static constexpr double allowed = 1e-9;

  /// The Laplacian, its components and the options are borrowed.
  BoundedProblem(const Laplacian& laplacian, const Components& components, const WeightOptions& options)
      : L_(laplacian.L),
        options_(options),
        points_(components.points),
        inverse_(inverseMasses(laplacian, components)),
        Q_(bendingMatrix(L_, inverse_)),
        diagonal_(Q_.diagonal()) {}

  /// @param is_free 1 at the points that may change
  /// @param[in,out] u N; the values of the others, and the solution
  /// @param[out] residual as WeightReport::residual
  /// @return systems solved
  int solve(const std::vector<std::uint8_t>& is_free, const Progress& progress, VectorXd& u, double& residual) const;

 private:
  enum class State : std::uint8_t { fixed, free, lower, upper };

  /// What bending says about each point, in weights: (Q u)_i / Q_ii, from differences.
  VectorXd pull(const VectorXd& u) const;
  /// Q over some points plus a diagonal, factored.
  LinearSystem factor(const std::vector<State>& state, const VectorXd& added, const Progress& progress) const;
  /// Guesses which points lie at a bound, by an interior point method.
  /// @param[in,out] state free points become lower or upper ones
  /// @return systems solved
  int guess(const Progress& progress, VectorXd u, std::vector<State>& state) const;
  void solveFree(const std::vector<State>& state, const Progress& progress, VectorXd& u) const;
  State wanted(State state, double value, double pulled) const;

  const SparseMatrix& L_;
  const WeightOptions& options_;
  const std::vector<int>& points_;
  VectorXd inverse_;   ///< N; mean mass of the component over mass
  SparseMatrix Q_;     ///< L M^-1 L, in 1 / mean mass
  VectorXd diagonal_;  ///< N; that of Q_
};

}  // namespace tufted
