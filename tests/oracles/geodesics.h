#pragma once

#include <array>
#include <optional>

#include "tufted/types.h"

namespace tufted::oracles {

/// Exact distances along the triangles from one point of them (CGAL::Surface_mesh_shortest_path), N values; NaN at
/// vertices of no triangle and in other components.
/// @param face,barycentric the source
/// @returns nothing where the triangles are no orientable manifold, which CGAL needs
std::optional<VectorXd> exactDistances(const Points& points, const Triangles& triangles, int face,
                                       const std::array<double, 3>& barycentric);

}  // namespace tufted::oracles
