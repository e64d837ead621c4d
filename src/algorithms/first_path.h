#pragma once

#include <vector>

#include "algorithms/march_faces.h"
#include "algorithms/strip.h"

// Paths that are to be straightened.

namespace tufted {

/// The way from a vertex down the distances to where they are 0, straight across each face to where its boundary is
/// nearest to the target, which is unfolded beyond each half of a side. Empty where it comes to a point from which none
/// is nearer, as where points are closer than their distances tell.
/// @param distance of the vertices and then of the middles of the edges, see MarchResult
/// @returns a strip from each vertex to the next
std::vector<Strip> stripsDownhill(const MarchFaces& faces, const std::vector<double>& distance, int from);

/// The shortest edge path between two vertices of one component (Dijkstra).
std::vector<Strip> stripsAlongEdges(const MarchFaces& faces, int from, int to);

}  // namespace tufted
