#pragma once

#include <cstdint>
#include <vector>

#include "tufted/laplacian.h"
#include "tufted/options.h"
#include "tufted/types.h"

namespace tufted {

/// Options of smooth().
struct SmoothingOptions {
  /// Time step t >= 0 in units of the mean squared edge length, report.mean_squared_edge. A wave of length 2 pi sqrt(t)
  /// times the root of that unit loses half its height in a step, shorter ones more.
  double time_step = 1;
  int iterations = 1;                                ///< steps >= 1, all with the Laplacian given
  const std::vector<std::uint8_t>* fixed = nullptr;  ///< N; points with an entry other than 0 stay in place; borrowed
  int threads = 0;                                   ///< at most this many; 0: one per processor
  Progress progress = {};                            ///< called while it smooths
};

/// Smooths positions by implicit steps of the heat equation, (M + t L) x' = M x for each coordinate; the matrix is
/// factorised once.
///
/// Every coordinate of x' lies in the range of x over the point's connected component. If no point of the component is
/// fixed, its sum(M x) does not change. Both hold up to rounding. (A point's mass below 1e-13 of t L's diagonal, which
/// would be lost in rounding, is raised to that.) Coincident points move with their representative, and stay if any one
/// of them is fixed; points that are not finite or isolated stay as they are.
/// @param points N x 3, those that the Laplacian was built from
/// @return N x 3
/// @throws InvalidInput for options out of range, arrays of the wrong size, or active points that are not finite
/// @throws SolverFailure when the matrix is not positive definite
/// @throws Cancelled when `options.progress` returns false
Points smooth(const Laplacian& laplacian, const PointsRef& points, const SmoothingOptions& options = {});

}  // namespace tufted
