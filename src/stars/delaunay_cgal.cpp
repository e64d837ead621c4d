#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_data_structure_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <utility>

#include "base/buffer.h"
#include "stars/delaunay_star.h"

namespace tufted {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<const PlanarPoint*, Kernel>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase>;
using Triangulation = CGAL::Delaunay_triangulation_2<Kernel, Structure>;

}  // namespace

void delaunayStarCgal(const Buffer<PlanarPoint>& candidates, int p, StarScratch& scratch, DelaunayStar& star) {
  Triangulation triangulation;
  const auto center = triangulation.insert(Kernel::Point_2(0, 0));
  center->info() = nullptr;
  for (const PlanarPoint& q : candidates) {
    if (q.u == 0 && q.v == 0) continue;
    const auto before = triangulation.number_of_vertices();
    const auto vertex = triangulation.insert(Kernel::Point_2(q.u, q.v));
    if (triangulation.number_of_vertices() > before) vertex->info() = &q;  // of equal positions the first is kept
  }

  // CGAL triangulates cocircular polygons arbitrarily. So the link of p and all vertices that are cocircular across its
  // link edges go to wrapChosen(), whose tie rule decides.
  scratch.chosen.clear();
  const auto circulator = triangulation.incident_vertices(center);
  if (circulator != nullptr) {
    auto vertex = circulator;
    do {
      if (!triangulation.is_infinite(vertex)) scratch.chosen.push_back(*vertex->info());
    } while (++vertex != circulator);
  }
  if (triangulation.dimension() == 2) {
    Buffer<std::pair<Triangulation::Face_handle, int>> fronts;  // a face and the index of its outward edge
    const auto around = triangulation.incident_faces(center);
    auto face = around;
    do {
      if (!triangulation.is_infinite(face)) fronts.emplace_back(face, face->index(center));
    } while (++face != around);
    while (!fronts.empty()) {
      const auto [inner, edge] = fronts.back();
      fronts.pop_back();
      const auto outer = inner->neighbor(edge);
      if (triangulation.is_infinite(outer)) continue;
      const PlanarPoint& a = *inner->vertex(Triangulation::ccw(edge))->info();
      const PlanarPoint& c = *inner->vertex(Triangulation::cw(edge))->info();
      const int opposite = outer->index(inner);
      if (outer->vertex(opposite) == center) continue;  // the star again, through another link edge
      const PlanarPoint& b = *outer->vertex(opposite)->info();
      if (orientation(a, b) <= 0 || orientation(b, c) <= 0 || sideOfCircle(a, b, c) != CircleSide::tie) continue;
      scratch.chosen.push_back(b);
      fronts.emplace_back(outer, Triangulation::ccw(opposite));
      fronts.emplace_back(outer, Triangulation::cw(opposite));
    }
  }
  wrapChosen(p, scratch, star);
}

}  // namespace tufted
