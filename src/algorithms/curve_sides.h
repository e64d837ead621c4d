#pragma once

#include <optional>
#include <vector>

#include "algorithms/connected.h"
#include "tufted/distance.h"
#include "tufted/laplacian.h"

namespace tufted {

/// A place of a curve whose corners are active and their own representatives.
struct CurvePlace {
  SurfacePoint point;
  Eigen::RowVector3d position;
};

/// A straight piece of a curve, whose ends lie on one component.
struct CurveSegment {
  CurvePlace from, to;
  int curve;                 ///< number of the curve
  Eigen::RowVector3d along;  ///< unit vector
  double length;             ///< > 0
};

/// The middle of a segment whose ends lie in one triangle, that of one of its places; otherwise empty.
std::optional<SurfacePoint> middleInTriangle(const CurveSegment& segment, const Points& positions);

/// Whether a segment is longer than the longest edges at its two ends together, so that points lie between them.
/// @param L whose entries join neighbours
bool skipsPoints(const CurveSegment& segment, const SparseMatrix& L, const Points& positions);

/// What says on which side of a curve points lie.
struct SideGeometry {
  const SparseMatrix& L;  ///< whose entries join neighbours
  const Points& positions;
  const Frames& frames;  ///< with normals of one sign
  const Components& components;
};

/// Signs distances from curves by the side on which the shortest path leaves the curve. Next to a curve the side is
/// that of the nearest segment in the tangent plane of each point. From there sides pass from nearer to farther points.
/// @param places further sources, which have no side and count as left
/// @param distance N; negated to the right of curves. At the corners of the triangle around a segment it is lowered to
/// the distance from the segment.
void signBySide(const SideGeometry& surface, const std::vector<CurveSegment>& segments,
                const std::vector<CurvePlace>& places, VectorXd& distance);

}  // namespace tufted
