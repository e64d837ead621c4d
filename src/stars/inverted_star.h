#pragma once

#include <span>

#include "neighbors/neighbors.h"
#include "simd/kernels.h"
#include "stars/delaunay_star.h"

namespace tufted {

/// The star of the origin as a convex hull: the inversion q -> q / |q|^2 turns circles through the origin into lines,
/// so that the link of the origin in the Delaunay triangulation is the hull of the inverted points.
///
/// Plain doubles with bounds on their rounding, for closed stars in which no two triangles around p come near to having
/// one circle. There the result is that of delaunayStar(), the link exactly and the radii up to rounding.
/// @param planar candidates by ascending distance in space; most stars are settled by the first few
/// @param neighbors who they are
/// @param tied where the star is tied, all that may be in its link: delaunayStar() of them is that of all
StarKind wrapInverted(const Kernels& kernels, const PlanarOffsets& planar, std::span<const Neighbor> neighbors,
                      DelaunayStar& star, Buffer<PlanarPoint>& tied);

}  // namespace tufted
