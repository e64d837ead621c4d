#pragma once

#include <cstdint>

#include "tufted/laplacian.h"
#include "tufted/options.h"
#include "tufted/types.h"

namespace tufted {

/// Options of surfaceTriangles().
struct TriangleOptions {
  Progress progress = {};  ///< called with the fraction of the triangles that have been looked at
};

/// What surfaceTriangles() found.
struct TriangleReport {
  std::int64_t triangles = 0;             ///< how many there are
  std::int64_t filled = 0;                ///< of these, those that close holes of three or four edges
  std::int64_t inner_edges = 0;           ///< edges of two triangles
  std::int64_t open_edges = 0;            ///< edges of one triangle; no edge has more than two
  std::int64_t nonmanifold_vertices = 0;  ///< points around which the triangles are several fans
  std::int64_t disagreeing_edges = 0;     ///< inner edges across which the orientation turns, as on a Moebius strip
  std::int64_t components = 0;            ///< sets of triangles that inner edges join
  double seconds = 0;                     ///< wall-clock
};

/// Triangles of a cloud to look at, and for programs that take meshes. Candidates are the triangles of the cover after
/// flips, which put most disagreements of stars onto the Delaunay diagonal. They are taken in the order of how many of
/// their corners have them, then of their circumradius, as long as no edge gets three and none overlaps another around
/// a corner, in the tangent plane there. Those that one corner alone has are taken where they close a gap between open
/// edges. What then remains open between three or four edges is closed, with the diagonal whose triangles more corners
/// have or, of equal ones, the one of the smaller circumradius.
///
/// Every edge has one or two triangles. They are oriented alike on each set that inner edges join: as most normals of
/// the frames if these have signs (Frames::orientation), else outwards or, where no volume is enclosed, so that the
/// largest coordinate of the mean normal is positive.
/// @param laplacian of a cloud, with its cover, frames and positions. Corners lie at Laplacian::positions.
/// @return F x 3 indices of points, sorted by their smallest one
/// @throws InvalidInput for a mesh, which has triangles of its own, for arrays of the wrong size, positions or frames
/// of active points that are not finite, or where there is no cover
/// @throws Cancelled when `options.progress` returns false
Triangles surfaceTriangles(const Laplacian& laplacian, const TriangleOptions& options = {},
                           TriangleReport* report = nullptr);

}  // namespace tufted
