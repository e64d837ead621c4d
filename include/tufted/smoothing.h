#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "tufted/laplacian.h"
#include "tufted/options.h"
#include "tufted/solver.h"
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

/// smooth() for one time step and one set of fixed points, factored once and used often: for positions that change, or
/// for any three functions on the points. Calls may run side by side. With the same options the results are those of
/// smooth() bit for bit.
class SmoothingSolver {
 public:
  /// @param laplacian shared, as every call looks at it; it must not change
  /// @param time_step as in SmoothingOptions
  /// @param fixed as in SmoothingOptions; not needed after construction
  /// @throws InvalidInput for a null pointer, values out of range, or arrays of the wrong size
  /// @throws SolverFailure when the matrix is not positive definite
  /// @throws Cancelled when `options.progress` returns false
  explicit SmoothingSolver(std::shared_ptr<const Laplacian> laplacian, double time_step = 1,
                           const std::vector<std::uint8_t>* fixed = nullptr, const SolverOptions& options = {});

  /// Smooths positions by some steps.
  /// @param points N x 3, finite at active points
  /// @param iterations steps >= 1
  /// @return as smooth(), whose errors it throws
  Points smooth(const PointsRef& points, int iterations = 1, const Progress& progress = {}) const;

  /// What the constructor did; without a method if no point moves or time_step is 0, as nothing is factorised then.
  const SolverReport& report() const;

  /// What is moved from may be assigned to or destroyed, and nothing else.
  SmoothingSolver(SmoothingSolver&&) noexcept;
  /// What is moved from may be assigned to or destroyed, and nothing else.
  SmoothingSolver& operator=(SmoothingSolver&&) noexcept;
  ~SmoothingSolver();

 private:
  struct State;
  std::unique_ptr<const State> state_;
};

}  // namespace tufted
