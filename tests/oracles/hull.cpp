#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <array>
#include <map>

#include "oracles/oracles.h"

namespace tufted::oracles {

Triangles convexHullMesh(const Points& points) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Point = Kernel::Point_3;
  std::vector<Point> input;
  std::map<Point, int> index;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    input.emplace_back(points(i, 0), points(i, 1), points(i, 2));
    index.try_emplace(input.back(), static_cast<int>(i));
  }
  CGAL::Surface_mesh<Point> hull;
  CGAL::convex_hull_3(input.begin(), input.end(), hull);

  // CGAL's order of faces depends on addresses of memory, and results depend on the order of triangles.
  std::vector<std::array<int, 3>> sorted;
  for (const auto face : hull.faces()) {
    std::array<int, 3> corners;
    int corner = 0;
    for (const auto vertex : hull.vertices_around_face(hull.halfedge(face)))
      corners[corner++] = index.at(hull.point(vertex));
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    sorted.push_back(corners);
  }
  std::sort(sorted.begin(), sorted.end());
  Triangles triangles(std::ssize(sorted), 3);
  for (Eigen::Index row = 0; row < triangles.rows(); ++row)
    for (int corner = 0; corner < 3; ++corner) triangles(row, corner) = sorted[row][corner];
  return triangles;
}

}  // namespace tufted::oracles
