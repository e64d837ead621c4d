#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "tufted/laplacian.h"
#include "tufted/options.h"
#include "tufted/types.h"
#include "tufted/vector_heat.h"

namespace tufted {

/// Work, accuracy and time of a query.
struct SignedDistanceReport {
  std::int64_t curve_points = 0;  ///< different points on the curve
  double curve_length = 0;        ///< sum of the lengths of its segments, in the caller's unit
  VectorHeatReport heat;          ///< of the transport of the curve's normals
  double residual = 0;            ///< of the solve for distances, see SolveReport
  double seconds = 0;             ///< wall-clock
};

/// Distances from curves on the surface, positive to their left (Feng, Crane: "A heat method for generalized signed
/// distance", 2024). Heat carries the normals of the curve along the surface to all points. The distance is the
/// function whose slope fits these directions best, shifted so that its mean over the curve is 0. So curves may be open
/// or have gaps. Across gaps the distance continues smoothly: there it is not the length of a path. Factored once,
/// queried often; queries may run in parallel.
class SignedDistanceSolver {
 public:
  /// @param laplacian with positions and frames, whose normals have one sign on each component (see orientedFrames());
  /// not needed after construction
  /// @throws InvalidInput for options out of range, arrays of the wrong size, a Laplacian without positions or frames,
  /// or active points whose positions or frames are not finite
  /// @throws SolverFailure when a matrix cannot be factorised
  /// @throws Cancelled when `options.solver.progress` returns false
  explicit SignedDistanceSolver(const Laplacian& laplacian, const VectorHeatOptions& options = {});
  /// This constructor takes frames of the caller, on meshes those of meshFrames(), in place of Laplacian::frames.
  SignedDistanceSolver(const Laplacian& laplacian, const Frames& frames, const VectorHeatOptions& options = {});

  /// Computes signed distances from a curve.
  /// @param curve C indices of points in order, the first one again at the end if the curve is closed, with at least
  /// two different points. Their spacing should be about that of the surface. Isolated and non-finite points are
  /// skipped, and a point that coincides with the one before it.
  /// @return N values in the points' unit, positive to the left of the curve as seen from the side that normals point
  /// to; NaN on components without a part of the curve and at isolated and non-finite points; coincident points as
  /// their representative
  /// @throws InvalidInput for an index out of range, no segment with both ends on one component, or only segments that
  /// are perpendicular to the tangent planes of their ends
  /// @throws SolverFailure for the same reasons as Solver::solve()
  /// @throws Cancelled when `progress` returns false
  VectorXd query(const std::vector<int>& curve, SignedDistanceReport* report = nullptr,
                 const Progress& progress = {}) const;

  /// The time step t, in the points' unit squared, of the component with the most points.
  double timeStep() const;
  /// How the constructor factored its systems, summed over them.
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
