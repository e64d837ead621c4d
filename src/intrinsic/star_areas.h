#pragma once

#include "base/parallel.h"
#include "base/point_buffer.h"
#include "cloud/kernels.h"
#include "cloud/stars.h"

namespace tufted {

/// The area that belongs to point p in its own star; 0 without triangles.
///
/// The Voronoi area where p and all its link vertices have whole stars and the neighbourhood is next to a plane: there
/// the stars agree, and the areas of neighbours fit together. Elsewhere the mixed area (Meyer et al. 2003), which no
/// obtuse triangle can turn negative.
/// @param fans unmollified; `at` is the first triangle of the star
double starArea(const Stars& stars, int p, const Fans& fans, int at);

/// The same for each, by the lengths between the moved points.
/// @param points n x 3, by rank
/// @returns n areas in units of `points` squared
Buffer<double> starAreas(const Stars& stars, const PointsView& points, const Workers& workers);

}  // namespace tufted
