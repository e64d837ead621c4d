#pragma once

#include <string>
#include <vector>

#include "tufted/distance.h"
#include "tufted/intrinsic_triangulation.h"

namespace tufted {

/// Where a source lies in a cover.
struct PlaceInCover {
  int source;          ///< number of the source
  int face;            ///< of the cover; -1: at a vertex
  SurfacePoint point;  ///< by the corners of the face, in their order
};

/// The places of sources in a cover, whose flips may have removed the triangles that the sources lie in. A point inside
/// a triangle has one place on its front and one on its back.
/// @param cover with corners in range
/// @param sources with corners in range
/// @returns by source, in their order
/// @throws InvalidInput for a cover that is not glued, or for a source in a triangle that the surface does not have
std::vector<PlaceInCover> placesInCover(const std::string& function, const IntrinsicTriangulation& cover,
                                        const std::vector<SurfacePoint>& sources);

}  // namespace tufted
