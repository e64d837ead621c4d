#pragma once

#include <vector>

#include "algorithms/march_faces.h"
#include "algorithms/strip.h"

// First paths between two vertices, not yet shortest.

namespace tufted {

/// The path from a vertex down the marched distance to where it is 0 (docs/algorithm.md, section 18, paths, step 1). In
/// each face it runs straight to where the other sides are nearest to the target, which is unfolded by the distances at
/// their ends and midpoints. Empty if no side leads nearer, as rounding may cause.
/// @param distance of the vertices, then of the midpoints of the edges, see MarchResult
/// @returns one strip from each vertex on the path to the next
std::vector<Strip> stripsDownhill(const MarchFaces& faces, const std::vector<double>& distance, int from);

/// The shortest edge path between two vertices of one component (Dijkstra).
std::vector<Strip> stripsAlongEdges(const MarchFaces& faces, int from, int to);

}  // namespace tufted
