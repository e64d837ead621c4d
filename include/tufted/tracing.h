#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>

#include "tufted/distance.h"
#include "tufted/laplacian.h"
#include "tufted/options.h"
#include "tufted/polyline.h"
#include "tufted/types.h"

namespace tufted {

/// Why a traced line ends.
enum class TraceEnd : std::uint8_t {
  length,     ///< it has the length that was asked for
  rim,        ///< the surface ends: an edge of one triangle, or a vertex at such an edge
  branch,     ///< an edge of more than two triangles, or a vertex at such an edge: no way on is straighter than another
  crossings,  ///< it has crossed a million edges, which a length in the wrong unit explains
};

/// The name of a reason: "length", "rim", "branch" or "crossings".
const char* nameOf(TraceEnd reason);

/// A straight line on a surface, as GeodesicTracer traces it.
struct TracedLine {
  Polyline line;     ///< from the start over all places where an edge is crossed or a vertex passed to the end
  SurfacePoint end;  ///< the end, in the triangle that the line reaches it through, or the starting vertex
  Eigen::RowVector3d direction = Eigen::RowVector3d::Zero();  ///< unit vector; where the line heads at its end, in the
                                                              ///< plane of that triangle
  TraceEnd reason = TraceEnd::length;                         ///< why it ends
};

/// Follows straight lines over triangles: the exponential map, the inverse of LogMapSolver. Prepared once, queried
/// often; queries may run in parallel.
///
/// Within a triangle a line is straight in space, and across an edge it is straight when both triangles are unfolded
/// into a plane (Polthier, Schmies: "Straightest geodesics on polyhedral surfaces", 1998). A vertex that it meets is
/// left with half of the total angle on each side. A line meets a vertex if it passes within 1e-9 of the longest side
/// of the triangle. It ends where the surface ends and where more than two triangles meet, see TraceEnd. Flips keep the
/// metric of the triangles, so these lines are those of the intrinsic triangulation, and lie on the triangles in space.
class GeodesicTracer {
 public:
  /// Prepares the triangles, in O(F log F). No Laplacian is needed for a mesh.
  /// @param points N x 3, in any unit of length: of a mesh; of a cloud Laplacian::positions
  /// @param triangles F x 3 indices into `points`: of a mesh; of a cloud surfaceTriangles(). Those with a repeated
  /// corner or one that is not finite are left out, and equal ones count once.
  /// @param frames N x 3 each, of meshFrames() or Laplacian::frames: directions at a vertex refer to its tangent plane
  /// @throws InvalidInput for an index out of range or arrays of different sizes
  GeodesicTracer(const PointsRef& points, const TrianglesRef& triangles, const Frames& frames);

  /// Traces a line.
  /// @param start a vertex, or a point inside a triangle
  /// @param direction any length > 0. It is projected into the plane of the triangle around the start; at a vertex into
  /// the tangent plane, and from there along the normal into the triangle that it meets. Where the tangent plane shows
  /// no triangle in this direction, the line ends at once if the surface ends at the vertex, and otherwise follows the
  /// edge whose direction is nearest.
  /// @param length >= 0, finite, in the points' unit
  /// @throws InvalidInput for a start of no triangle, a direction that is not finite, 0 or perpendicular to the plane,
  /// a triangle without area around the start, or a length out of range
  /// @throws Cancelled when `progress` returns false
  TracedLine query(const SurfacePoint& start, const Eigen::RowVector3d& direction, double length,
                   const Progress& progress = {}) const;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

}  // namespace tufted
