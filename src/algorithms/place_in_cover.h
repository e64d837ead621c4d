#pragma once

#include <string>
#include <vector>

#include "base/cover_source.h"
#include "tufted/distance.h"

namespace tufted {

/// Where a source lies in a cover.
struct PlaceInCover {
  int source;          ///< number of the source
  int face;            ///< face of the cover; -1: at a vertex
  SurfacePoint point;  ///< the source by the corners of that face, in their order
};

/// Checks the numbers of a source on a surface of n points.
/// @param function named in errors
/// @throws InvalidInput for a corner, weight or length out of range
void checkPlace(const std::string& function, const SurfacePoint& source, int n);

/// The places of sources in a cover, where flips may have removed the triangles around them (docs/algorithm.md, section
/// 18). A point inside a triangle has one place on the front and one on the back.
/// @param cover with corners in range; asked for only if a source lies inside a triangle
/// @param sources with corners in range
/// @returns places in the order of the sources
/// @throws InvalidInput for a cover that is not glued, or for a source in a triangle that the surface does not have
std::vector<PlaceInCover> placesInCover(const std::string& function, const CoverSource& source_of_cover,
                                        const std::vector<SurfacePoint>& sources);

}  // namespace tufted
