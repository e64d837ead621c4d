#pragma once

#include <array>
#include <vector>

#include "tufted/laplacian.h"
#include "tufted/surface_triangles.h"

namespace tufted {

/// Orients triangles as surfaceTriangles() says.
/// @param[in,out] triangles of which no edge has more than two; some are turned
/// @param[in,out] report gets the edges, components and disagreements
void orientTriangles(const Laplacian& laplacian, std::vector<std::array<int, 3>>& triangles, TriangleReport& report);

}  // namespace tufted
