#pragma once

#include <cstdint>
#include <vector>

#include "tufted/types.h"

namespace tufted::oracles {

struct PlanarMesh {
  Points points;  ///< z = 0
  Triangles triangles;
};

/// Delaunay triangles of points in the plane z = 0 in a metric in which y is stretched (by the lower convex hull of a
/// paraboloid). A stretch of 1 gives the Delaunay triangulation, more gives slivers along x.
Triangles stretchedDelaunay(const Points& points, double stretch);

/// The unit square with its corners and `inner` random points inside. Triangles at its long edges have obtuse angles
/// opposite the boundary, which flips cannot remove (the paper's Figure 15).
PlanarMesh obtuseSquare(int inner, double stretch, std::uint64_t seed);

/// The inner point nearest to each side of obtuseSquare(), which has the widest angle there, and pinned values 0, 1,
/// 0, 1.
struct ObtusePins {
  std::vector<int> points;
  Eigen::MatrixXd values;
};
ObtusePins pinsAtObtuseCorners(const PlanarMesh& mesh);

/// Unit square pages that meet at the spine x = y = 0, 0 <= z <= 1, of n edges, each with about n^2 / 2 random points
/// and the triangles of stretchedDelaunay() (the paper's Figure 16).
struct Book {
  Points points;
  Triangles triangles;
  VectorXd outward;       ///< N; distance from the spine
  std::vector<int> page;  ///< N; -1 on the spine
};
Book badBook(int pages, int n, double stretch, std::uint64_t seed);
/// Exact distances from a point, by unfolding pages into one plane.
VectorXd bookDistances(const Book& book, int source);

}  // namespace tufted::oracles
