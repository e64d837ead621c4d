#pragma once

#include "tufted/laplacian.h"

namespace tufted::bench {

/// The union of stars under a cloud's cover, with all copies of a triangle, before flips, unlike Laplacian::cover().
/// @param points,options those that `laplacian` was built from
/// @return F x 3 indices of points; the first corner is the point of the star
/// @throws std::logic_error if `laplacian` was built from another union
Triangles unionOfStars(const Points& points, const CloudOptions& options, const Laplacian& laplacian);

}  // namespace tufted::bench
