#pragma once

#include <span>
#include <vector>

#include "algorithms/march.h"

namespace tufted {

/// The starts of each source, in an order in which the first ones are spread over the list, as neighbours in the list
/// are often neighbours on the surface: by the reversed bits of their place.
/// @param starts sorted by source
std::vector<std::span<const MarchStart>> spreadSources(const std::vector<MarchStart>& starts);

/// Lowers bounds of the distances from the nearest source to the lengths of ways along edges (Dijkstra 1959).
/// @param bound of the vertices and, if it has more entries, of the midpoints of edges
void boundAlongEdges(const MarchFaces& faces, const std::vector<MarchStart>& starts, std::vector<double>& bound);

}  // namespace tufted
