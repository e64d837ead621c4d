#pragma once

#include <cstdint>

#include "base/buffer.h"
#include "base/parallel.h"
#include "base/point_buffer.h"
#include "simd/kernels.h"
#include "stars/stars.h"

namespace tufted {

/// The two areas that may belong to each point in its own star; both are 0 without triangles.
struct StarAreas {
  RawBuffer<double> voronoi;         ///< n, signed; means nothing where circumcentres lie far beyond the star
  RawBuffer<double> mixed;           ///< n, of Meyer et al. 2003; never negative, never more than the star's triangles
  RawBuffer<std::uint8_t> is_bound;  ///< n, 1 where the Voronoi area is at most 20 times the mixed one, either sign

  void resize(int count);
  /// Measures star p.
  /// @param fans unmollified; `at` is the first triangle of the star
  void measure(const Stars& stars, int p, const TriangleFans& fans, int at);
};

/// The area that belongs to each point in its own star.
struct OwnAreas {
  RawBuffer<double> area;    ///< n
  std::int64_t bounded = 0;  ///< points that would have taken their Voronoi area, were it not for its bounds
};

/// The Voronoi area where p and all its link vertices have whole stars and Voronoi areas within their bounds, that of p
/// is not far below the mixed area, and the neighbourhood is next to a plane: there the stars agree, and the areas of
/// neighbours fit together. Elsewhere the mixed area.
///
/// Where a surface is as narrow as its triangles are long, Voronoi cells reach far beyond it: without bounds a point
/// could get more than the whole surface. So no point gets more than 20 times the area of its star's triangles.
OwnAreas chooseAreas(const Stars& stars, StarAreas areas, const Workers& workers);

/// Measures all stars by the lengths between the points, and chooses.
/// @param points n x 3, by rank
/// @returns areas in units of `points` squared
OwnAreas ownAreas(const Stars& stars, const PointsView& points, const Workers& workers);

}  // namespace tufted
