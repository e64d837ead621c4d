#pragma once

#include <cstdint>
#include <vector>

#include "tufted/types.h"

namespace tufted::oracles {

struct PlanarMesh {
  Points points;  ///< z = 0
  Triangles triangles;
};

/// Delaunay triangles of points in the plane z = 0 in a metric that counts y `stretch` times (by the lower convex hull
/// of a paraboloid): with 1 the Delaunay triangulation, with more slivers along x, all with the given points.
Triangles stretchedDelaunay(const Points& points, double stretch);

/// The unit square with its four corners and `inner` random points: no point on the long edges between corners, so
/// triangles there have obtuse angles opposite the boundary, and no flip can mend that (Figure 15).
PlanarMesh obtuseSquare(int inner, double stretch, std::uint64_t seed);

/// The inner point nearest to each side of obtuseSquare, and how to pin it: 0, 1, 0, 1. Its triangle with the side has
/// the widest angle there is.
struct ObtusePins {
  std::vector<int> points;
  Eigen::MatrixXd values;
};
ObtusePins pinsAtObtuseCorners(const PlanarMesh& mesh);

/// Unit square pages that meet at the spine x = y = 0, 0 <= z <= 1, of n edges; each with about n^2 / 2 random points
/// and the triangles of stretchedDelaunay (Figure 16).
struct Book {
  Points points;
  Triangles triangles;
  VectorXd outward;       ///< N; distance from the spine
  std::vector<int> page;  ///< N; -1 on the spine
};
Book badBook(int pages, int n, double stretch, std::uint64_t seed);
/// Exact distances from a point: pages unfold into one plane.
VectorXd bookDistances(const Book& book, int source);

}  // namespace tufted::oracles
