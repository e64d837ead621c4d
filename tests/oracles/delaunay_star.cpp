#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include "oracles/oracles.h"

namespace tufted::oracles {

PlanarStar delaunayStarOracle(const Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>& points) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Vertex = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
  using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex>>;
  Delaunay delaunay;
  const auto origin = delaunay.insert(Kernel::Point_2(0, 0));
  origin->info() = -1;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const std::size_t before = delaunay.number_of_vertices();
    const auto vertex = delaunay.insert(Kernel::Point_2(points(i, 0), points(i, 1)));
    if (delaunay.number_of_vertices() > before) vertex->info() = static_cast<int>(i);
  }
  PlanarStar star;
  if (delaunay.dimension() < 2) return star;

  star.closed = true;
  const auto first = delaunay.incident_faces(origin);
  auto face = first;
  // An open star is listed from its gap on, where infinite faces follow each other.
  do {
    if (delaunay.is_infinite(face)) star.closed = false;
  } while (++face != first);
  if (!star.closed) {
    while (!delaunay.is_infinite(face)) ++face;
    while (delaunay.is_infinite(face)) ++face;
  }
  const auto start = face;
  do {
    if (delaunay.is_infinite(face)) continue;
    const int k = face->index(origin);
    star.triangles.push_back({face->vertex(Delaunay::ccw(k))->info(), face->vertex(Delaunay::cw(k))->info()});
  } while (++face != start);
  return star;
}

}  // namespace tufted::oracles
