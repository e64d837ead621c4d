#include "oracles/geodesics.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>

#include <limits>
#include <vector>

namespace tufted::oracles {

std::optional<VectorXd> exactDistances(const Points& points, const Triangles& triangles, int face,
                                       const std::array<double, 3>& barycentric) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
  using ShortestPath = CGAL::Surface_mesh_shortest_path<CGAL::Surface_mesh_shortest_path_traits<Kernel, Mesh>>;
  namespace processing = CGAL::Polygon_mesh_processing;

  // Vertices of no triangle are left out, because the search does not accept them.
  std::vector<int> number(points.rows(), -1), input_index;
  std::vector<Kernel::Point_3> corners;
  std::vector<std::array<std::size_t, 3>> soup;
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    std::array<std::size_t, 3> polygon{};
    for (int k = 0; k < 3; ++k) {
      const int i = triangles(f, k);
      if (number[i] < 0) {
        number[i] = static_cast<int>(corners.size());
        input_index.push_back(i);
        corners.emplace_back(points(i, 0), points(i, 1), points(i, 2));
      }
      polygon[k] = static_cast<std::size_t>(number[i]);
    }
    soup.push_back(polygon);
  }
  const std::size_t vertices = corners.size();
  // Orienting duplicates vertices if the triangles are no manifold.
  if (!processing::orient_polygon_soup(corners, soup) || corners.size() != vertices) return std::nullopt;
  if (!processing::is_polygon_soup_a_polygon_mesh(soup)) return std::nullopt;
  Mesh mesh;
  processing::polygon_soup_to_polygon_mesh(corners, soup, mesh);

  // CGAL's weights begin at the source of the face's halfedge, which need not be our first corner.
  const auto source = *(mesh.faces_begin() + face);
  const auto side = mesh.halfedge(source);
  const std::array<Mesh::Vertex_index, 3> around = {mesh.source(side), mesh.target(side), mesh.target(mesh.next(side))};
  std::array<double, 3> weights{};
  for (int k = 0; k < 3; ++k) {
    for (int c = 0; c < 3; ++c) {
      if (number[triangles(face, c)] == static_cast<int>(around[k].idx())) weights[k] = barycentric[c];
    }
  }
  ShortestPath search(mesh);
  search.add_source_point(source, {{weights[0], weights[1], weights[2]}});
  VectorXd result = VectorXd::Constant(points.rows(), std::numeric_limits<double>::quiet_NaN());
  for (const auto vertex : mesh.vertices()) {
    const double distance = search.shortest_distance_to_source_points(vertex).first;
    if (distance >= 0) result[input_index[vertex.idx()]] = distance;
  }
  return result;
}

}  // namespace tufted::oracles
