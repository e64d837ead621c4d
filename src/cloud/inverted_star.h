#pragma once

#include <span>
#include <vector>

#include "cloud/delaunay_star.h"

namespace tufted {

/// The star of the origin as a convex hull: the inversion q -> q / |q|^2 turns circles through the origin into lines,
/// so that the link of the origin in the Delaunay triangulation is the hull of the inverted points.
///
/// Plain doubles with bounds on their rounding, for closed stars in which no two triangles around p come near to having
/// one circle. There the result is that of delaunayStar(), link and radii.
/// @param candidates by ascending distance in space; most stars are settled by the first few
/// @returns false, and nothing of use, where the star is open or too close to call
bool wrapInverted(std::span<const PlanarPoint> candidates, DelaunayStar& star);

}  // namespace tufted
