#pragma once

#include <string>

#include "tufted/types.h"

namespace tufted::support {

/// Outcome of comparing stars with CGAL::Delaunay_triangulation_2 on the same projected doubles.
struct StarComparison {
  int stars = 0;      ///< stars compared
  int with_ties = 0;  ///< stars that differ only in edges within the tie band
  int different = 0;  ///< stars that differ otherwise
  std::string first_difference;
};

/// Compares the stars of every `step`-th point of a cloud, in its 30 nearest neighbours projected to its tangent plane,
/// with those of the oracle and, if built, of Delaunay::cgal. They may differ only if four points are cocircular within
/// the tie band.
StarComparison compareStars(const Points& points, int step);

}  // namespace tufted::support
