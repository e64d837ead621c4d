#include "bench/compare/patches.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <utility>

namespace tufted::bench {

Patch patchOf(const NearestPoints& points, int point, int k) {
  const Eigen::RowVector3d place = points.points().row(point);
  std::vector<std::size_t> near = points.of(place, std::max(k, plane_neighbors) + 1);
  const auto fitted = std::min(static_cast<int>(near.size()), plane_neighbors + 1);
  const Frame frame = frameOf(rowsOf(points.points(), near, fitted));
  std::erase(near, static_cast<std::size_t>(point));
  near.resize(std::min(near.size(), static_cast<std::size_t>(k)));
  Patch patch;
  const auto n = static_cast<Eigen::Index>(near.size());
  const Eigen::MatrixX3d local = (rowsOf(points.points(), near, static_cast<int>(n)).rowwise() - place) * frame.axes;
  patch.index.assign(near.begin(), near.end());
  patch.plane = local.leftCols<2>();
  patch.height = local.col(2);
  return patch;
}

oracles::PlanarStar starOf(const Patch& patch, int k) {
  return oracles::delaunayStarOracle(patch.plane.topRows(std::min<Eigen::Index>(k, patch.plane.rows())));
}

VectorXd cornerAreas(const Patch& patch) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Vertex = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
  using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex>>;
  std::vector<std::pair<Kernel::Point_2, int>> sites = {{{0, 0}, -1}};
  for (int i = 0; i < patch.plane.rows(); ++i) sites.push_back({{patch.plane(i, 0), patch.plane(i, 1)}, i});
  const Delaunay delaunay(sites.begin(), sites.end());
  VectorXd areas = VectorXd::Zero(patch.plane.rows());
  for (auto face = delaunay.finite_faces_begin(); face != delaunay.finite_faces_end(); ++face) {
    const double area = delaunay.triangle(face).area();
    for (int corner = 0; corner < 3; ++corner)
      if (const int i = face->vertex(corner)->info(); i >= 0) areas[i] += area / 3;
  }
  return areas;
}

SparseMatrix fromWeights(const std::vector<Eigen::Triplet<double>>& weights, Eigen::Index n) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& weight : weights) {
    entries.emplace_back(weight.row(), weight.col(), -weight.value());
    entries.emplace_back(weight.row(), weight.row(), weight.value());
  }
  SparseMatrix L(n, n);
  L.setFromTriplets(entries.begin(), entries.end());
  return L;
}

}  // namespace tufted::bench
