#pragma once

#include <span>

#include "cloud/delaunay_star.h"
#include "cloud/kernels.h"
#include "cloud/neighbors.h"

namespace tufted {

/// The star of the origin as a convex hull: the inversion q -> q / |q|^2 turns circles through the origin into lines,
/// so that the link of the origin in the Delaunay triangulation is the hull of the inverted points.
///
/// Plain doubles with bounds on their rounding, for closed stars in which no two triangles around p come near to having
/// one circle. There the result is that of delaunayStar(), the link exactly and the radii up to rounding.
/// @param planar candidates by ascending distance in space; most stars are settled by the first few
/// @param neighbors who they are
/// @returns false, and nothing of use, where the star is open or too close to call
bool wrapInverted(const Kernels& kernels, const PlanarOffsets& planar, std::span<const Neighbor> neighbors,
                  DelaunayStar& star);

}  // namespace tufted
