#pragma once

#include "tufted/memory_layout.h"
#include "tufted/types.h"

namespace tufted {

/// Splits every polygon of n vertices into n - 2 triangles by ear clipping in the plane of its Newell normal,
/// keeping its orientation. Polygons of fewer than three vertices give nothing. A polygon that is degenerate or
/// crosses itself still gives n - 2 triangles.
/// @throws InvalidInput for an index outside [0, points.rows())
Triangles triangulate(const Points& points, const Polygons& polygons);

}  // namespace tufted
