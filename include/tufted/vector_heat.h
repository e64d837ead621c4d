#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "tufted/laplacian.h"
#include "tufted/options.h"
#include "tufted/solver.h"
#include "tufted/types.h"

namespace tufted {

/// Options of the solvers of the vector heat method.
struct VectorHeatOptions {
  /// Time step t, in units of the mean squared distance of neighbours in L on each component, in [1e-4, 1e12]. Smaller
  /// ones depend more on single points; larger ones mix what comes from several sources, or around both sides of an
  /// obstacle.
  double time_step = 4;
  /// How systems are solved. `memory_limit` bounds all factors that a solver holds together.
  SolverOptions solver = {};
};

/// Work, accuracy and time of a query.
struct VectorHeatReport {
  int rounds = 0;             ///< rounds of heat, each starting where the last one became too small
  int iterations = 0;         ///< most conjugate gradient iterations of any solve; 0 with Cholesky
  double residual = 0;        ///< greatest residual of any solve, see SolveReport
  double backward_error = 0;  ///< greatest backward error of any solve, see SolveReport
  double seconds = 0;         ///< wall-clock
};

/// Extends values from some points to all points, nearly those of the nearest source (Sharp, Soliman, Crane: "The
/// vector heat method", 2019, Section 4): u / phi, where (M + t L) u is the sum of the values at the sources, and (M +
/// t L) phi that of ones there. Factored once, queried often; queries may run in parallel.
class ExtensionSolver {
 public:
  /// @param laplacian with positions; not needed after construction
  /// @throws InvalidInput for options out of range, arrays of the wrong size, a Laplacian without positions, or active
  /// points whose positions are not finite
  /// @throws SolverFailure when the matrix cannot be factorised
  /// @throws Cancelled when `options.solver.progress` returns false
  explicit ExtensionSolver(const Laplacian& laplacian, const VectorHeatOptions& options = {});

  /// Extends values. Each result lies within the range of the sources' values on its component, up to rounding. At a
  /// source it is a mixture of its own value and those of sources a few spacings away. Several values at one place
  /// count as their mean.
  /// @param sources S indices of points; isolated and non-finite ones are ignored
  /// @param values S x c, finite
  /// @return N x c; NaN where no path leads and at isolated and non-finite points; coincident points as their
  /// representative
  /// @throws InvalidInput for no source, an index out of range, arrays of different sizes, values that are not finite,
  /// or no source on any component
  /// @throws SolverFailure for the same reasons as Solver::solve()
  /// @throws Cancelled when `progress` returns false
  Eigen::MatrixXd query(const std::vector<int>& sources, const Eigen::MatrixXd& values,
                        VectorHeatReport* report = nullptr, const Progress& progress = {}) const;

  /// The time step t, in the points' unit squared, of the component with the most points.
  double timeStep() const;
  /// How the constructor factored its system.
  const SolverReport& report() const;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

/// Transports tangent vectors from some points to all points, parallel along the shortest paths (Sharp, Soliman, Crane
/// 2019, Algorithm 1). Directions are those of Y, where (M + t L') Y is the sum of the vectors at the sources and L' is
/// L with its off-diagonals multiplied by the smallest rotations between the tangent planes of neighbours. Lengths are
/// extended as by ExtensionSolver. Where the normals of two neighbours point to different sides, one is negated first,
/// so signs of normals do not matter. Factored once, queried often; queries may run in parallel.
class TransportSolver {
 public:
  /// @param laplacian with positions and frames, as a cloud's; not needed after construction
  /// @throws InvalidInput for options out of range, arrays of the wrong size, a Laplacian without positions or frames,
  /// or active points whose positions or frames are not finite
  /// @throws SolverFailure when a matrix cannot be factorised
  /// @throws Cancelled when `options.solver.progress` returns false
  explicit TransportSolver(const Laplacian& laplacian, const VectorHeatOptions& options = {});
  /// This constructor takes frames of the caller, on meshes those of meshFrames(), in place of Laplacian::frames.
  TransportSolver(const Laplacian& laplacian, const Frames& frames, const VectorHeatOptions& options = {});

  /// Transports vectors.
  /// @param sources S indices of points; isolated and non-finite ones are ignored
  /// @param vectors S x 3, finite, projected into the tangent planes of their points; those at one place are averaged
  /// @return N x 3 tangent vectors; 0 where no path leads and at isolated and non-finite points; coincident points as
  /// their representative
  /// @throws InvalidInput for no source, an index out of range, arrays of different sizes, vectors that are not finite
  /// or perpendicular to their tangent plane, or no source on any component
  /// @throws SolverFailure for the same reasons as Solver::solve()
  /// @throws Cancelled when `progress` returns false
  Points query(const std::vector<int>& sources, const Points& vectors, VectorHeatReport* report = nullptr,
               const Progress& progress = {}) const;

  /// The time step t, in the points' unit squared, of the component with the most points.
  double timeStep() const;
  /// How the constructor factored its systems, summed over them.
  const SolverReport& report() const;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

/// Polar coordinates around a point, as LogMapSolver finds them.
struct LogMap {
  Eigen::MatrixX2d coordinates;  ///< N x 2; distance times (cos, sin) of the angle, in the points' unit
  Eigen::RowVector3d first;      ///< unit vector; the direction of the first coordinate at the source
  Eigen::RowVector3d second;     ///< unit vector; the direction of the second, cross(normal of the source, first)
  VectorHeatReport report;       ///< work, accuracy and time
};

/// How logarithmic maps are computed.
enum class LogMapMethod : std::uint8_t {
  exact,  ///< shortest paths over the triangles; on even ones a query takes time that grows with N^1.5
  heat,   ///< the vector heat method: fast queries on millions of points, but angles are off by some degrees
};

/// Options of LogMapSolver.
struct LogMapOptions {
  LogMapMethod method = LogMapMethod::exact;  ///< how the map is computed
  double time_step = 4;                       ///< heat: see VectorHeatOptions
  SolverOptions solver = {};                  ///< heat: how systems are solved; `progress` is of both
};

/// The logarithmic map: for each point, the direction at the source and the length of the shortest path to it. Prepared
/// once, queried often; queries may run in parallel.
///
/// Exact: paths are those of PathSolver on a mesh, on its cover, and of a cloud on surfaceTriangles(). GeodesicTracer
/// follows a path back to its point where no saddle lies on the way, and passes beside it where one does: no straight
/// line leads there. Points in no triangle get the direction of a neighbour. Lengths are exact to rounding; so are
/// directions, except beside an edge at the source that was flipped, where they follow the corners of the triangle.
/// Around a vertex of N triangles time grows with N^2, and in thin triangles lines wind without an end, which is
/// refused.
///
/// Heat (Sharp, Soliman, Crane 2019, Section 8.2): the distance is that of DistanceSolver, the angle that between two
/// transported fields: the axes at the source, and the directions away from it. The latter start in a ring some
/// spacings around the source, where they are measured in its tangent plane: at its next neighbours they would depend
/// on where these happen to lie.
class LogMapSolver {
 public:
  /// @param laplacian with its cover, positions and frames, as a cloud's; not needed after construction
  /// @throws InvalidInput, SolverFailure and Cancelled as TransportSolver(), and InvalidInput if there is no cover
  explicit LogMapSolver(const Laplacian& laplacian, const LogMapOptions& options = {});
  /// This constructor takes frames of the caller, on meshes those of meshFrames(), in place of Laplacian::frames.
  LogMapSolver(const Laplacian& laplacian, const Frames& frames, const LogMapOptions& options = {});

  /// Computes the coordinates of all points: 0 at the source; NaN where no path leads and at isolated and non-finite
  /// points; coincident points as their representative. At the cut locus, where several paths are equally short, exact
  /// angles are those of one of them; those of heat are mixed near there.
  /// @param source index of an active point
  /// @param axis direction of the first coordinate, projected into the tangent plane of the source; 0: the frame's
  /// tangent
  /// @throws InvalidInput for an index out of range, a source that is not active, or an axis that is not finite or
  /// perpendicular to the tangent plane
  /// @throws SolverFailure for the same reasons as Solver::solve(); exact: where lines wind without an end
  /// @throws Cancelled when `progress` returns false
  LogMap query(int source, const Eigen::RowVector3d& axis = Eigen::RowVector3d::Zero(),
               const Progress& progress = {}) const;

  /// Heat: how the constructor factored its systems, summed over them. Exact: method "exact", and its memory.
  const SolverReport& report() const;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

}  // namespace tufted
