#pragma once

#include "tufted/options.h"
#include "tufted/types.h"

namespace tufted {

/// Splits every polygon of n vertices into n - 2 triangles of the same orientation, by ear clipping in the plane of its
/// Newell normal. Polygons of fewer than three vertices give none. A polygon that is degenerate or crosses itself still
/// gives n - 2 triangles.
///
/// The best shaped ear is clipped first. 100,000 vertices take less than a second. The time grows as n log n, on
/// needles between scattered vertices as n sqrt(n). Takes about 100 bytes per vertex of the largest polygon beside the
/// result.
/// @param points N x 3
/// @param polygons indices into `points`
/// @param progress called every few thousand triangles
/// @return F x 3 indices into `points`, in the order of the polygons
/// @throws InvalidInput for an index outside [0, points.rows())
/// @throws std::length_error for a polygon of more than 2^30 vertices
/// @throws Cancelled when `progress` returns false
Triangles triangulate(const Points& points, const Polygons& polygons, const Progress& progress = {});

}  // namespace tufted
