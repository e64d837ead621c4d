#pragma once

#include <array>
#include <optional>

#include "tufted/types.h"

namespace tufted::oracles {

/// Exact distances along the triangles from a point on them (CGAL::Surface_mesh_shortest_path).
/// @param face,barycentric the source
/// @return N, NaN at vertices of no triangle and on other components; nullopt if no orientable manifold is given
std::optional<VectorXd> exactDistances(const Points& points, const Triangles& triangles, int face,
                                       const std::array<double, 3>& barycentric);

}  // namespace tufted::oracles
