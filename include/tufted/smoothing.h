#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "tufted/laplacian.h"
#include "tufted/options.h"
#include "tufted/solver.h"
#include "tufted/types.h"

namespace tufted {

/// How points are smoothed.
enum class SmoothingMethod : std::uint8_t {
  implicit,  ///< implicit steps of the heat equation: of any size, within the range of what was; shapes shrink
  taubin,    ///< a step towards the mean of the neighbours, then one away from it: shapes hardly shrink (Taubin 1995)
};

/// Options of smooth().
struct SmoothingOptions {
  SmoothingMethod method = SmoothingMethod::implicit;  ///< how points are smoothed
  /// The time step of SmoothingMethod::implicit: t >= 0 in units of the mean squared edge length of each component,
  /// which is ComponentEdges::mean_square, so that a component is smoothed as if it were alone. A wave of length 2 pi
  /// sqrt(t) times the root of that unit loses half its height in a step, shorter ones more.
  double time_step = 1;
  /// Of SmoothingMethod::taubin: the part of the way to the mean of the neighbours, in (0, 1].
  double lambda = 0.5;
  /// Of SmoothingMethod::taubin: the part of the way in the second half of a step, in [-1, 0]. Waves whose k = 1 - mean
  /// of the neighbours is below 1 / lambda + 1 / mu are kept. (1 - 2 lambda) (1 - 2 mu) must be at least -1, or the
  /// shortest waves would grow.
  double mu = -0.53;
  int iterations = 1;                                ///< steps >= 1, all with the Laplacian given
  const std::vector<std::uint8_t>* fixed = nullptr;  ///< N; points with an entry other than 0 stay in place; borrowed
  /// F x 3 triangles of closed surfaces, as those of a mesh or surfaceTriangles(), whose volume is kept: in the end
  /// each component is scaled about its centre of mass (Desbrun et al. 1999). On a cloud they may have holes of at most
  /// 5 % of the area. Not with `fixed`. Borrowed.
  const Triangles* volume_of = nullptr;
  int threads = 0;         ///< at most this many; 0: one per processor
  Progress progress = {};  ///< called while it smooths
};

/// Smooths positions: by implicit steps of the heat equation, (M + t L) x' = M x for each coordinate, of which the
/// matrix is factorised once; or as Taubin ("A signal processing approach to fair surface design", 1995) by the weights
/// of L, x' = x - lambda D^-1 L x and then mu in place of lambda, D the diagonal of L.
///
/// Of implicit steps: every coordinate of x' lies in the range of x over the point's connected component. If no point
/// of the component is fixed, its sum(M x) does not change. Both hold up to rounding. (A point's mass below 1e-13 of t
/// L's diagonal, which would be lost in rounding, is raised to that.) Coincident points move with their representative,
/// and stay if any one of them is fixed; points that are not finite or isolated stay as they are.
/// @param points N x 3, those that the Laplacian was built from
/// @return N x 3
/// @throws InvalidInput for options out of range, arrays of the wrong size, a Laplacian without `component_edges` (of
///         implicit steps), or active points that are not finite; with `volume_of` for components that are not closed
///         and oriented, or enclose no volume
/// @throws SolverFailure when the matrix is not positive definite
/// @throws Cancelled when `options.progress` returns false
Points smooth(const Laplacian& laplacian, const PointsRef& points, const SmoothingOptions& options = {});

/// smooth() for any functions on the points, without `volume_of`.
/// @param values N x c, finite at active points
/// @return N x c; the values of points that are not finite or isolated stay, coincident points have those of their
///         representative
/// @throws as smooth()
Eigen::MatrixXd smoothValues(const Laplacian& laplacian, const Eigen::MatrixXd& values,
                             const SmoothingOptions& options = {});

/// smooth() by implicit steps for one time step and one set of fixed points, factored once and used often: for
/// positions that change, or for any three functions on the points. Calls may run side by side. With the same options
/// the results are those of smooth() bit for bit.
class SmoothingSolver {
 public:
  /// @param laplacian shared, as every call looks at it; it must not change
  /// @param time_step as in SmoothingOptions
  /// @param fixed as in SmoothingOptions; not needed after construction
  /// @throws InvalidInput for a null pointer, values out of range, arrays of the wrong size, or a Laplacian without
  ///         `component_edges`
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

  /// A moved-from solver may only be destroyed or assigned to.
  SmoothingSolver(SmoothingSolver&&) noexcept;
  /// A moved-from solver may only be destroyed or assigned to.
  SmoothingSolver& operator=(SmoothingSolver&&) noexcept;
  ~SmoothingSolver();

 private:
  struct State;
  std::unique_ptr<const State> state_;
};

}  // namespace tufted
