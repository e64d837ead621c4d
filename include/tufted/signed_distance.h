#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "tufted/laplacian.h"
#include "tufted/options.h"
#include "tufted/types.h"
#include "tufted/vector_heat.h"

namespace tufted {

/// What SignedDistanceSolver::query() did.
struct SignedDistanceReport {
  std::int64_t curve_points = 0;  ///< places on the curve
  double curve_length = 0;        ///< of the segments between them, in the caller's unit
  VectorHeatReport heat;          ///< of the normals of the curve
  double residual = 0;            ///< of the distances, see SolveReport
  double seconds = 0;             ///< wall-clock
};

/// Distances from curves on the surface, positive to their left (Feng, Crane: "A heat method for generalized signed
/// distance", 2024). Heat carries the normals of the curve to all points, along the surface; the distance is the
/// function whose slope is nearest to these directions, and 0 in the mean over the curve. So curves may be open or
/// have gaps, across which the distance goes on smoothly: there it is no length of a path. Factored once, queried
/// often; queries may run side by side.
class SignedDistanceSolver {
 public:
  /// @param laplacian with positions and frames, whose normals have one sign on each component (see orientedFrames());
  /// not needed after construction
  /// @throws InvalidInput for options out of range, arrays of the wrong size, a Laplacian without positions or frames,
  /// or those of active points that are not finite
  /// @throws SolverFailure when a matrix cannot be factorised
  /// @throws Cancelled when `options.solver.progress` returns false
  explicit SignedDistanceSolver(const Laplacian& laplacian, const VectorHeatOptions& options = {});
  /// As above in the caller's frames: for meshes those of meshFrames().
  SignedDistanceSolver(const Laplacian& laplacian, const Frames& frames, const VectorHeatOptions& options = {});

  /// @param curve C indices of points in order, at least two places; the last one is the first again where the curve is
  /// closed. Points should follow each other about as closely as those of the surface do. Those that are not active,
  /// and one that coincides with that before it, are passed over.
  /// @return N values in the points' unit, positive to the left of the curve seen from the normals' side; NaN on
  /// components without a part of the curve, at isolated points and those that are not finite; a coincident point has
  /// its representative's
  /// @throws InvalidInput for an index out of range, fewer than two places on one component, or segments that stand on
  /// the tangent planes of their ends
  /// @throws SolverFailure as Solver::solve
  /// @throws Cancelled when `progress` returns false
  VectorXd query(const std::vector<int>& curve, SignedDistanceReport* report = nullptr,
                 const Progress& progress = {}) const;

  /// The time step t in use, in the points' unit squared, on the component that has the most points.
  double timeStep() const;
  /// What the constructor did, all systems together.
  const SolverReport& report() const;

  /// A moved-from solver may only be destroyed or assigned to.
  SignedDistanceSolver(SignedDistanceSolver&&) noexcept;
  /// A moved-from solver may only be destroyed or assigned to.
  SignedDistanceSolver& operator=(SignedDistanceSolver&&) noexcept;
  ~SignedDistanceSolver();

 private:
  struct State;
  std::unique_ptr<const State> state_;
};

}  // namespace tufted
