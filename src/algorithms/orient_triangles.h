#pragma once

#include <array>
#include <vector>

#include "tufted/laplacian.h"
#include "tufted/surface_triangles.h"

namespace tufted {

/// Orients triangles consistently, then as most of their normals or outwards, see surfaceTriangles().
/// @param[in,out] triangles at most two at an edge; some are reversed
/// @param[in,out] report gets the edges, components and disagreements
void orientTriangles(const Laplacian& laplacian, std::vector<std::array<int, 3>>& triangles, TriangleReport& report);

}  // namespace tufted
