#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tufted/distance.h"
#include "tufted/laplacian.h"
#include "tufted/options.h"
#include "tufted/types.h"
#include "tufted/vector_heat.h"

namespace tufted {

/// Options of SignedDistanceSolver.
struct SignedDistanceOptions {
  DistanceMethod method = DistanceMethod::heat;  ///< how distances are computed
  std::optional<int> split = {};                 ///< marching: see DistanceOptions::split
  double time_step = 4;                          ///< heat: see VectorHeatOptions::time_step
  SolverOptions solver = {};  ///< as VectorHeatOptions::solver; marching uses `threads` and `progress`
};

/// A curve on the surface: its places in order, the first one again at the end if the curve is closed.
using SurfaceCurve = std::vector<SurfacePoint>;

/// Work, accuracy and time of a query.
struct SignedDistanceReport {
  std::int64_t curve_points = 0;   ///< different points on the curves; of a place in a triangle, the triangle's corners
  double curve_length = 0;         ///< sum of the lengths of the segments, in the caller's unit
  std::int64_t segments = 0;       ///< pairs of consecutive places on one component, at different positions
  std::int64_t long_segments = 0;  ///< those longer than the longest edges at their two ends together
  VectorHeatReport heat;           ///< heat: of the transport of the normals of the curves
  double residual = 0;             ///< heat: of the solve for distances, see SolveReport
  DistanceReport march;            ///< marching: of the distances without sign
  double seconds = 0;              ///< wall-clock
};

/// A sentence to warn of segments that are too long, empty if there are none: between their ends lie points that no
/// place of the curve names, so that there distances are not from the curve.
std::string longSegmentsWarning(const SignedDistanceReport& report);

/// Distances from curves on the surface, positive to their left. Prepared once, queried often; queries may run in
/// parallel.
///
/// Heat (Feng, Crane: "A heat method for generalized signed distance", 2024) carries the normals of all curves along
/// the surface to all points. The distance is the function whose slope fits these directions best, shifted so that its
/// mean over all curves is 0 on each component. So several curves count as pieces of one, whose left sides should
/// agree, and curves may be open or have gaps. Across gaps the distance continues smoothly: there it is not the length
/// of a path.
///
/// Marching gives each point the distance of DistanceSolver from the nearest place of any curve, at the corners of the
/// triangle around a segment that from the segment. It is negative if the shortest path leaves the curve to the right.
/// So it is the least by magnitude of the distances from each curve, and its sign changes where paths from both sides
/// meet. A path from the end of an open curve counts as one from the side of the last segment, extended straight. Sides
/// come from the normals at a curve and next to it, which may mislead on a thin plate without vertices off its edges.
class SignedDistanceSolver {
 public:
  /// @param laplacian with positions and frames, whose normals have one sign on each component (see orientedFrames());
  /// for marching also with its cover; not needed after construction
  /// @throws InvalidInput for options out of range, arrays of the wrong size, a Laplacian without positions or frames,
  /// for marching without cover, or active points whose positions or frames are not finite
  /// @throws SolverFailure when a matrix cannot be factorised
  /// @throws Cancelled when `options.solver.progress` returns false
  explicit SignedDistanceSolver(const Laplacian& laplacian, const SignedDistanceOptions& options = {});
  /// This constructor takes frames of the caller, on meshes those of meshFrames(), in place of Laplacian::frames.
  SignedDistanceSolver(const Laplacian& laplacian, const Frames& frames, const SignedDistanceOptions& options = {});

  /// Computes signed distances from a curve of points or vertices; values and errors are those of queryAt().
  /// @param curve C indices of points in order, the first one again at the end if the curve is closed
  VectorXd query(const std::vector<int>& curve, SignedDistanceReport* report = nullptr,
                 const Progress& progress = {}) const;

  /// Computes signed distances from the nearest of several curves and points.
  /// @param curves of vertices or places inside triangles, with at least two different places. Neighbours in a curve
  /// should be joined by an edge of L, or lie about a spacing apart, see longSegmentsWarning(). Isolated and non-finite
  /// points are skipped, and a place that coincides with the one before it.
  /// @param points marching: further sources, which have no side: distances from them are positive. Points alone have
  /// the distances of DistanceSolver.
  /// @return N values in the points' unit, positive to the left of the curves as seen from the side that normals point
  /// to, where several sheets meet at a curve on each sheet by its own normals; NaN on components without a source and
  /// at isolated and non-finite points; coincident points as their representative
  /// @throws InvalidInput for an index out of range, no curve and no point, curves without a segment with both ends on
  /// one component, or of which all segments are perpendicular to the tangent planes of their ends, points with the
  /// method heat, or no point on any component; for marching also for a place inside a triangle that is not one of the
  /// surface
  /// @throws SolverFailure for the same reasons as Solver::solve()
  /// @throws Cancelled when `progress` returns false
  VectorXd queryAt(const std::vector<SurfaceCurve>& curves, const std::vector<SurfacePoint>& points = {},
                   SignedDistanceReport* report = nullptr, const Progress& progress = {}) const;

  /// The time step t, in the points' unit squared, of the component with the most points; 0 for marching.
  double timeStep() const;
  /// How the constructor factored its systems, summed over them; for marching that of DistanceSolver.
  const SolverReport& report() const;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

}  // namespace tufted
