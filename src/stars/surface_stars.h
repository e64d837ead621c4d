#pragma once

#include "base/parallel.h"
#include "stars/stars.h"

namespace tufted {

/// The stars that the cover is made of.
struct SurfaceStars : BuiltStars {
  Buffer<std::uint8_t> disagrees;  ///< n, see findDisagreement()
};

/// Filters the triangles of stars between points as the options say, and finds where the stars disagree. Books its
/// stage.
SurfaceStars filteredStars(BuiltStars built, bool is_whole_cloud, const PointsView& points, const CloudOptions& options,
                           const Workers& workers, Report& report);

/// Builds stars, isolates outliers and filters triangles as the options say. Books every stage.
SurfaceStars surfaceStars(const RankedCloud& cloud, const NeighborSource& source, const CloudOptions& options,
                          const Workers& workers, Report& report);

}  // namespace tufted
