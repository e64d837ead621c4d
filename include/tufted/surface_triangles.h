#pragma once

#include <cstdint>

#include "tufted/laplacian.h"
#include "tufted/options.h"
#include "tufted/types.h"

namespace tufted {

/// Options of surfaceTriangles().
struct TriangleOptions {
  Progress progress = {};  ///< called with the fraction of the candidates that were examined
};

/// Counts and time of a call of surfaceTriangles().
struct TriangleReport {
  std::int64_t triangles = 0;             ///< number of triangles
  std::int64_t filled = 0;                ///< of these, those that close holes of three or four edges
  std::int64_t inner_edges = 0;           ///< edges of two triangles
  std::int64_t open_edges = 0;            ///< edges of one triangle; no edge has more than two
  std::int64_t nonmanifold_vertices = 0;  ///< points around which the triangles form several fans
  std::int64_t disagreeing_edges = 0;     ///< inner edges across which the orientation changes, as on a Moebius strip
  std::int64_t components = 0;            ///< sets of triangles connected by inner edges
  double seconds = 0;                     ///< wall-clock
};

/// Selects triangles of a cloud that form a surface, for display and for programs that take meshes. Candidates are the
/// triangles of the cover after flips, which resolve most disagreements of stars to the Delaunay diagonal. A candidate
/// has a vote from each corner whose star has it. Candidates are taken in the order of votes, then of circumradius,
/// unless an edge would get three triangles or two triangles would overlap in the tangent plane of a corner. Those with
/// one vote are taken only where they close a gap between open edges. Remaining holes of three or four edges are then
/// closed, with the diagonal whose triangles have more votes or, if equal, the smaller circumradius.
///
/// Every edge has one or two triangles. Each set of triangles connected by inner edges is oriented consistently: as
/// most normals of the frames if these have signs (Frames::orientation), otherwise outwards or, if no volume is
/// enclosed, so that the largest coordinate of the mean normal is positive.
/// @param laplacian of a cloud, with its cover, frames and positions; corners lie at Laplacian::positions
/// @return F x 3 indices of points, sorted by their smallest one
/// @throws InvalidInput for a mesh, which has triangles of its own, arrays of the wrong size, active points whose
/// positions or frames are not finite, or a Laplacian without cover
/// @throws Cancelled when `options.progress` returns false
Triangles surfaceTriangles(const Laplacian& laplacian, const TriangleOptions& options = {},
                           TriangleReport* report = nullptr);

}  // namespace tufted
