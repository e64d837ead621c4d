#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

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

  Triangles triangles(hull.number_of_faces(), 3);
  Eigen::Index row = 0;
  for (const auto face : hull.faces()) {
    int corner = 0;
    for (const auto vertex : hull.vertices_around_face(hull.halfedge(face))) {
      triangles(row, corner++) = index.at(hull.point(vertex));
    }
    ++row;
  }
  return triangles;
}

}  // namespace tufted::oracles
