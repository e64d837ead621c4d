#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "tufted/laplacian.h"
#include "tufted/solver.h"

namespace tufted {

/// Options of boundedBiharmonicWeights().
struct WeightOptions {
  int max_iterations = 500;   ///< systems of one handle, >= 1; SolverFailure if they do not suffice
  SolverOptions solver = {};  ///< how systems are solved; multigrid is not fit for them
};

/// What boundedBiharmonicWeights() did.
struct WeightReport {
  std::int64_t handles = 0;      ///< columns
  std::int64_t free = 0;         ///< active points on components with a handle, but for the handles' own
  std::int64_t not_reached = 0;  ///< points that are NaN: on components without a handle, or taking no part
  int iterations = 0;            ///< the most systems that a handle took
  /// The greatest violation of the conditions of Karush, Kuhn and Tucker before weights are divided by their sum, in
  /// weights: by how much one of them would change if the others stayed.
  double residual = 0;
  std::int64_t local_maxima = 0;  ///< points with a weight above that of all neighbours and of no handle, all columns
  double greatest_sum_error = 0;  ///< by which sums of a point's weights were off 1 before they were divided by them
  double seconds = 0;             ///< wall-clock
};

/// Bounded biharmonic weights (Jacobson, Baran, Popovic, Sorkine: "Bounded biharmonic weights for real-time
/// deformation", 2011; Sharp and Crane 2020, Figure 14): for each handle the function of the least bending, u^T L M^-1
/// L u, that is 1 at its points and 0 at those of all other handles and lies in [0, 1]. In the end each point's weights
/// are divided by their sum.
///
/// Each handle's problem is solved exactly: an interior point method (Mehrotra 1992) guesses which points lie at a
/// bound, then points are exchanged between free ones and either bound until all signs are right (Judice, Pires: "A
/// block principal pivoting algorithm for large-scale strictly monotone linear complementarity problems", 1994), and
/// the free ones solved for.
/// @param handles H sets of points, each with at least one; coincident points count as their representative
/// @return N x H in [0, 1], with sum 1; NaN on components without a handle, at isolated points and those that are not
///         finite; a coincident point has its representative's
/// @throws InvalidInput for options out of range, arrays of the wrong size, an index out of range, no handle, a handle
///         without an active point, or a point of two handles
/// @throws SolverFailure when a system cannot be solved, or iterations do not suffice
/// @throws Cancelled when `options.solver.progress` returns false
Eigen::MatrixXd boundedBiharmonicWeights(const Laplacian& laplacian, const std::vector<std::vector<int>>& handles,
                                         const WeightOptions& options = {}, WeightReport* report = nullptr);

}  // namespace tufted
