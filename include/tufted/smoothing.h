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
  implicit,  ///< implicit steps of the heat equation: of any size, and values stay in their range; shapes shrink
  taubin,    ///< each step goes towards the mean of the neighbours and back: shapes hardly shrink (Taubin 1995)
};

/// Options of smooth().
struct SmoothingOptions {
  SmoothingMethod method = SmoothingMethod::implicit;  ///< how points are smoothed
  /// For implicit: time step t in [0, 1e10], in units of the mean squared edge length of each component
  /// (ComponentEdges::mean_square), so that each component is smoothed as if it were alone. A wave of length 2 pi
  /// sqrt(t) times the root of that unit loses half its height in a step, shorter ones more.
  double time_step = 1;
  /// For taubin: the part of the way to the mean of the neighbours that a point moves, in (0, 1].
  double lambda = 0.5;
  /// For taubin: the part of the way in the second half of a step, in [-1, 0]. Waves with an eigenvalue of D^-1 L, D
  /// the diagonal of L, below 1 / lambda + 1 / mu are kept. (1 - 2 lambda) (1 - 2 mu) must be at least -1, or the
  /// shortest waves would grow.
  double mu = -0.53;
  int iterations = 1;                                ///< steps >= 1, all with the Laplacian given
  const std::vector<std::uint8_t>* fixed = nullptr;  ///< N; points with an entry other than 0 stay in place; borrowed
  /// F x 3 triangles of closed surfaces, as those of a mesh or surfaceTriangles(), whose volume is kept: at the end
  /// each component is scaled about its centre of mass (Desbrun et al. 1999). On a cloud they may have holes of at most
  /// 5 % of the area. Not with `fixed`. Borrowed.
  const Triangles* volume_of = nullptr;
  SolverOptions solver = {};  ///< how the matrix is factorised (implicit), threads and progress
};

/// Smooths positions: by implicit steps of the heat equation, (M + t L) x' = M x for each coordinate, whose matrix is
/// factorised once; or as Taubin ("A signal processing approach to fair surface design", 1995) with the weights of L,
/// x' = x - lambda D^-1 L x and then mu in place of lambda, where D is the diagonal of L.
///
/// Implicit steps keep every coordinate of x' in the range of x over the point's connected component, and sum(M x) if
/// no point of the component is fixed, both up to rounding. (A mass below 1e-13 of t times L's diagonal, which would be
/// lost in rounding, is raised to that.) Coincident points move with their representative, and stay if any one of them
/// is fixed; isolated and non-finite points stay as they are.
/// @param points N x 3, those that the Laplacian was built from
/// @return N x 3, in the unit of the points
/// @throws InvalidInput for options out of range, arrays of the wrong size, active points that are not finite, a
/// Laplacian without `component_edges` (implicit), both `volume_of` and `fixed`, or components of `volume_of` that are
/// not closed and oriented or enclose no volume
/// @throws SolverFailure when the matrix is not positive definite
/// @throws Cancelled when `options.solver.progress` returns false
Points smooth(const Laplacian& laplacian, const PointsRef& points, const SmoothingOptions& options = {});

/// Smooths any functions on the points, as smooth() but without `volume_of`; errors are those of smooth().
/// @param values N x c, finite at active points
/// @return N x c; isolated and non-finite points keep their values, coincident points as their representative
Eigen::MatrixXd smoothValues(const Laplacian& laplacian, const Eigen::MatrixXd& values,
                             const SmoothingOptions& options = {});

/// smooth() by implicit steps for one time step and one set of fixed points: factored once, used often, for positions
/// that change or any three functions on the points. Calls may run in parallel. With the same options the results have
/// the same bits as those of smooth().
class SmoothingSolver {
 public:
  /// @param laplacian not needed after construction
  /// @param options `time_step`, `fixed`, which is not needed after construction, and `solver`
  /// @throws InvalidInput for SmoothingMethod::taubin, `volume_of`, values out of range, arrays of the wrong size, or a
  /// Laplacian without `component_edges`
  /// @throws SolverFailure when the matrix is not positive definite
  /// @throws Cancelled when `options.solver.progress` returns false
  explicit SmoothingSolver(const Laplacian& laplacian, const SmoothingOptions& options = {});

  /// Smooths positions; result and errors are those of smooth().
  /// @param points N x 3, finite at active points
  /// @param iterations number of steps, >= 1
  Points query(const PointsRef& points, int iterations = 1, const Progress& progress = {}) const;

  /// How the constructor factored its system; `method` is empty if no point moves or time_step is 0.
  const SolverReport& report() const;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

}  // namespace tufted
