#pragma once

#include <string>

#include "tufted/types.h"

namespace tufted::support {

/// Outcome of comparing stars with CGAL::Delaunay_triangulation_2 on the same projected doubles.
struct StarComparison {
  int stars = 0;      ///< compared
  int with_ties = 0;  ///< equal but for edges within the tie band
  int different = 0;  ///< really different
  std::string first_difference;
};

/// Takes every `step`-th point of a cloud, projects its 30 nearest neighbours to its tangent plane and compares our
/// star with the oracle's, and with our CGAL backend where that is built. They may differ only where four points are
/// cocircular within the tie band.
StarComparison compareStars(const Points& points, int step);

}  // namespace tufted::support
