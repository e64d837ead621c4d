#pragma once

#include <span>

#include "neighbors/neighbors.h"
#include "simd/kernels.h"
#include "stars/delaunay_star.h"

namespace tufted {

/// The star of the origin as a convex hull: the inversion q -> q / |q|^2 turns circles through the origin into lines,
/// so that the link of the origin in the Delaunay triangulation is the hull of the inverted points.
///
/// Plain doubles with bounds on their rounding, for closed stars in which no two neighbouring circles nearly coincide
/// (*The fast way* in section 6 of docs/algorithm.md). There the link is that of delaunayStar(), and radii are up to
/// rounding.
/// @param planar candidates by ascending distance in space; the first few decide most stars
/// @param neighbors their ranks
/// @param[out] tied for StarKind::tied, all candidates that may be in the link: delaunayStar() of these is that of all
StarKind wrapInverted(const Kernels& kernels, const PlanarOffsets& planar, std::span<const Neighbor> neighbors,
                      DelaunayStar& star, Buffer<PlanarPoint>& tied);

}  // namespace tufted
