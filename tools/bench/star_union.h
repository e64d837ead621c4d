#pragma once

#include "tufted/laplacian.h"

namespace tufted::bench {

/// The union of stars that a cloud's cover is made of, all copies of a triangle counted, before the flips, which join
/// other corners. Laplacian::cover() is flipped, hence no substitute.
/// @param points what `laplacian` was built from, with the same `options`
/// @returns F x 3 rows of `points`; the first corner is the star's own
/// @throws std::logic_error when this is not the union that `laplacian` was built from
Triangles unionOfStars(const Points& points, const CloudOptions& options, const Laplacian& laplacian);

}  // namespace tufted::bench
