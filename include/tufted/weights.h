#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "tufted/laplacian.h"
#include "tufted/solver.h"

namespace tufted {

/// Options of boundedBiharmonicWeights().
struct WeightOptions {
  int max_iterations = 500;   ///< linear systems solved per handle, >= 1; SolverFailure if they do not suffice
  SolverOptions solver = {};  ///< how systems are solved; SolverMethod::multigrid is a SolverFailure
};

/// Counts, accuracy and time of a call of boundedBiharmonicWeights().
struct WeightReport {
  std::int64_t handles = 0;      ///< number of handles, columns of the result
  std::int64_t free = 0;         ///< active points on components with a handle that belong to none
  std::int64_t not_reached = 0;  ///< points whose weights are NaN: on components without a handle, or taking no part
  int iterations = 0;            ///< the most linear systems that a handle took
  /// Greatest violation of the Karush-Kuhn-Tucker conditions before weights are divided by their sum, as a weight: by
  /// how much a single weight would change if it were optimised with all others kept.
  double residual = 0;
  std::int64_t local_maxima = 0;  ///< points of no handle with a weight above that of all neighbours, over all columns
  double greatest_sum_error = 0;  ///< greatest |sum of a point's weights - 1| before they were divided by it
  double seconds = 0;             ///< wall-clock
};

/// Computes bounded biharmonic weights (Jacobson, Baran, Popovic, Sorkine: "Bounded biharmonic weights for real-time
/// deformation", 2011; Sharp and Crane 2020, Figure 14): for each handle the function u with the least bending u^T L
/// M^-1 L u that is 1 at its points, 0 at those of all other handles, and in [0, 1]. At last the weights of each point
/// are divided by their sum.
///
/// The problem of each handle is solved exactly: an interior point method (Mehrotra 1992) estimates which points lie at
/// a bound. Then points are exchanged between free ones and either bound until all signs are right, with a solve for
/// the free ones each time (Judice, Pires: "A block principal pivoting algorithm for large-scale strictly monotone
/// linear complementarity problems", 1994).
/// @param handles H sets of points, each with at least one; coincident points count as their representative
/// @return N x H in [0, 1], rows of sum 1; NaN on components without a handle and at isolated and non-finite points;
/// coincident points as their representative
/// @throws InvalidInput for options out of range, arrays of the wrong size, an index out of range, no handle, a handle
///         without an active point, or a point of two handles
/// @throws SolverFailure when a system cannot be solved, iterations do not suffice, or all weights of a point are 0
/// @throws Cancelled when `options.solver.progress` returns false
Eigen::MatrixXd boundedBiharmonicWeights(const Laplacian& laplacian, const std::vector<std::vector<int>>& handles,
                                         const WeightOptions& options = {}, WeightReport* report = nullptr);

}  // namespace tufted
