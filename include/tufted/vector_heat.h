#pragma once

#include <memory>
#include <vector>

#include "tufted/laplacian.h"
#include "tufted/options.h"
#include "tufted/solver.h"
#include "tufted/types.h"

namespace tufted {

/// Options of the solvers of the vector heat method.
struct VectorHeatOptions {
  /// Time step t > 0, in the mean squared distance of neighbours in L on each component, between Laplacian::positions.
  /// Smaller ones depend more on single points, larger ones mix what comes from several sources, or around both sides
  /// of an obstacle.
  double time_step = 4;
  /// How systems are solved. `memory_limit` bounds all factors that a solver holds together.
  SolverOptions solver = {};
};

/// What a query did.
struct VectorHeatReport {
  int rounds = 0;             ///< rounds of heat, each of which starts where the last one became too small
  int iterations = 0;         ///< most conjugate gradient iterations of any solve; 0 with Cholesky
  double residual = 0;        ///< greatest residual of any solve, see SolveReport
  double backward_error = 0;  ///< greatest backward error of any solve, see SolveReport
  double seconds = 0;         ///< wall-clock
};

/// Values of some points carried to all, nearly those of the nearest source (Sharp, Soliman, Crane: "The vector heat
/// method", 2019, Section 4): u / phi, where (M + t L) u = sum of the values at the sources, and (M + t L) phi = sum of
/// ones there. Factored once, queried often; queries may run side by side.
class ExtensionSolver {
 public:
  /// @param laplacian with positions; not needed after construction
  /// @throws InvalidInput for options out of range, arrays of the wrong size, or a Laplacian without positions
  /// @throws SolverFailure when the matrix cannot be factorised
  /// @throws Cancelled when `options.solver.progress` returns false
  explicit ExtensionSolver(const Laplacian& laplacian, const VectorHeatOptions& options = {});

  /// Every value lies within the range of the sources' values on its component, but for rounding; at a source it is its
  /// own mixed with those of sources a few spacings away. Several values at one place count as their mean.
  /// @param sources S indices of points; those that are not active are ignored
  /// @param values S x c, finite
  /// @return N x c; NaN where no path leads, at isolated points and at those that are not finite; a coincident point
  /// has its representative's values
  /// @throws InvalidInput for no source, an index out of range, arrays of different sizes, values that are not finite,
  /// or no source on any component
  /// @throws SolverFailure as Solver::solve
  /// @throws Cancelled when `progress` returns false
  Eigen::MatrixXd query(const std::vector<int>& sources, const Eigen::MatrixXd& values,
                        VectorHeatReport* report = nullptr, const Progress& progress = {}) const;

  /// The time step t in use, in the points' unit squared, on the component that has the most points.
  double timeStep() const;
  /// What the constructor did.
  const SolverReport& report() const;

  /// A moved-from solver may only be destroyed or assigned to.
  ExtensionSolver(ExtensionSolver&&) noexcept;
  /// A moved-from solver may only be destroyed or assigned to.
  ExtensionSolver& operator=(ExtensionSolver&&) noexcept;
  ~ExtensionSolver();

 private:
  struct State;
  std::unique_ptr<const State> state_;
};

/// Tangent vectors of some points carried to all, parallel along the shortest paths (Sharp, Soliman, Crane 2019,
/// Algorithm 1). Directions are those of Y, (M + t L') Y = sum of the vectors at the sources, where L' is L with the
/// smallest rotation between the tangent planes of two neighbours in place of each off-diagonal 1; lengths are extended
/// as ExtensionSolver does. Where two normals point to different sides, one counts with the other sign, so signs of
/// normals do not matter. Factored once, queried often; queries may run side by side.
class TransportSolver {
 public:
  /// @param laplacian with positions and frames, as that of a cloud has; not needed after construction
  /// @throws InvalidInput for options out of range, arrays of the wrong size, a Laplacian without positions or frames,
  /// or those of active points that are not finite
  /// @throws SolverFailure when a matrix cannot be factorised
  /// @throws Cancelled when `options.solver.progress` returns false
  explicit TransportSolver(const Laplacian& laplacian, const VectorHeatOptions& options = {});
  /// As above in the caller's frames: for meshes those of meshFrames().
  TransportSolver(const Laplacian& laplacian, const Frames& frames, const VectorHeatOptions& options = {});

  /// @param sources S indices of points; those that are not active are ignored
  /// @param vectors S x 3, finite, projected into the tangent planes of their points; those at one place are averaged
  /// @return N x 3 tangent vectors; 0 where no path leads, at isolated points and at those that are not finite; a
  /// coincident point has its representative's
  /// @throws InvalidInput for no source, an index out of range, arrays of different sizes, vectors that are not finite
  /// or stand on their tangent plane, or no source on any component
  /// @throws SolverFailure as Solver::solve
  /// @throws Cancelled when `progress` returns false
  Points query(const std::vector<int>& sources, const Points& vectors, VectorHeatReport* report = nullptr,
               const Progress& progress = {}) const;

  /// The time step t in use, in the points' unit squared, on the component that has the most points.
  double timeStep() const;
  /// What the constructor did, all systems together.
  const SolverReport& report() const;

  /// A moved-from solver may only be destroyed or assigned to.
  TransportSolver(TransportSolver&&) noexcept;
  /// A moved-from solver may only be destroyed or assigned to.
  TransportSolver& operator=(TransportSolver&&) noexcept;
  ~TransportSolver();

 private:
  struct State;
  std::unique_ptr<const State> state_;
};

/// Polar coordinates around a point, as LogMapSolver finds them.
struct LogMap {
  Eigen::MatrixX2d coordinates;  ///< N x 2; distance times (cos, sin) of the angle, in the points' unit
  Eigen::RowVector3d first;      ///< unit; the direction of the first coordinate at the source
  Eigen::RowVector3d second;     ///< unit; the direction of the second, cross(normal of the source, first)
  VectorHeatReport report;       ///< what happened
};

/// The logarithmic map: for each point, in which direction and how far from the source its shortest path goes (Sharp,
/// Soliman, Crane 2019, Section 8.2). The distance is that of DistanceSolver; the angle is the one between two
/// transported fields, the axes at the source and the directions that lead away from it. The latter start in a ring
/// some spacings around the source, where they are those in the tangent plane: at its next neighbours they would
/// depend on where these happen to lie. Factored once, queried often; queries may run side by side.
class LogMapSolver {
 public:
  /// @param laplacian with its cover, positions and frames, as that of a cloud has; not needed after construction
  /// @throws as TransportSolver, and InvalidInput where there is no cover
  explicit LogMapSolver(const Laplacian& laplacian, const VectorHeatOptions& options = {});
  /// As above in the caller's frames: for meshes those of meshFrames().
  LogMapSolver(const Laplacian& laplacian, const Frames& frames, const VectorHeatOptions& options = {});

  /// Coordinates are 0 at the source and NaN where no path leads, at isolated points and at those that are not finite;
  /// a coincident point has its representative's. Next to the cut locus, where several shortest paths meet, angles are
  /// mixed.
  /// @param source index of an active point
  /// @param axis direction of the first coordinate, projected into the tangent plane of the source; 0: the frame's
  /// tangent
  /// @throws InvalidInput for an index out of range, a source that is not active, or an axis that is not finite or
  /// stands on the tangent plane
  /// @throws SolverFailure as Solver::solve
  /// @throws Cancelled when `progress` returns false
  LogMap query(int source, const Eigen::RowVector3d& axis = Eigen::RowVector3d::Zero(),
               const Progress& progress = {}) const;

  /// What the constructor did, all systems together.
  const SolverReport& report() const;

  /// A moved-from solver may only be destroyed or assigned to.
  LogMapSolver(LogMapSolver&&) noexcept;
  /// A moved-from solver may only be destroyed or assigned to.
  LogMapSolver& operator=(LogMapSolver&&) noexcept;
  ~LogMapSolver();

 private:
  struct State;
  std::unique_ptr<const State> state_;
};

}  // namespace tufted
