#pragma once

#include "base/parallel.h"
#include "stars/stars.h"

namespace tufted {

/// The stars from which the cover is made.
struct SurfaceStars : BuiltStars {
  Buffer<std::uint8_t> disagrees;  ///< n, see findDisagreement()
};

/// Filters triangles, chooses diagonals, finds where the stars disagree and counts votes (section 7 of
/// docs/algorithm.md, after outliers). Records its stage.
SurfaceStars filteredStars(BuiltStars built, bool is_whole_cloud, const PointsView& points, const CloudOptions& options,
                           const Workers& workers, Report& report);

/// Builds stars, isolates outliers and calls filteredStars(), as the options say. Records every stage.
SurfaceStars surfaceStars(const RankedCloud& cloud, const NeighborSource& source, const CloudOptions& options,
                          const Workers& workers, Report& report);

}  // namespace tufted
