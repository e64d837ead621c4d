#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "attacks/dense_oracle.h"

namespace tufted::attacks {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex>>;
using Face = Delaunay::Face_handle;

/// Width of the tie band, in radians, and what is left of it or beyond is decided by rounding.
constexpr double band = 1e-9, unsure = 1e-11;
/// Angles nearer to 0 or pi than this: all four points of a quadrilateral may be nearly on a line.
constexpr double thin = 1e-6;

double angleAt(const Kernel::Point_2& at, const Kernel::Point_2& a, const Kernel::Point_2& b) {
  const auto u = a - at, v = b - at;
  return std::abs(std::atan2(u.x() * v.y() - u.y() * v.x(), u * v));
}

class TiedCells {
 public:
  TiedCells(const Delaunay& delaunay, TiedStar& star) : delaunay_(delaunay), star_(star) {}

  /// The vertices of all faces that are tied to `face`, counterclockwise.
  std::vector<Delaunay::Vertex_handle> cellOf(const Face& face) {
    std::vector<Face> cell = {face};
    std::set<Delaunay::Vertex_handle> corners;
    for (std::size_t at = 0; at < cell.size(); ++at) {
      for (int i = 0; i < 3; ++i) {
        corners.insert(cell[at]->vertex(i));
        const Face other = cell[at]->neighbor(i);
        if (delaunay_.is_infinite(other) || !isTied(cell[at], i)) continue;
        if (std::find(cell.begin(), cell.end(), other) == cell.end()) cell.push_back(other);
      }
    }
    std::vector<Delaunay::Vertex_handle> polygon(corners.begin(), corners.end());
    double x = 0, y = 0;
    for (const auto& v : polygon) {
      x += v->point().x() / static_cast<double>(polygon.size());
      y += v->point().y() / static_cast<double>(polygon.size());
    }
    const auto direction = [&](const auto& v) { return std::atan2(v->point().y() - y, v->point().x() - x); };
    std::sort(polygon.begin(), polygon.end(),
              [&](const auto& a, const auto& b) { return direction(a) < direction(b); });
    return polygon;
  }

 private:
  bool isTied(const Face& face, int i) {
    const auto a = face->vertex(Delaunay::ccw(i))->point(), b = face->vertex(Delaunay::cw(i))->point();
    const double here = angleAt(face->vertex(i)->point(), a, b);
    const double there = angleAt(delaunay_.mirror_vertex(face, i)->point(), a, b);
    if (std::min(here, there) < thin || std::max(here, there) > std::numbers::pi - thin) star_.doubtful = true;
    const double off = std::abs(here + there - std::numbers::pi);
    if (off > unsure && off < 100 * band) star_.doubtful = true;
    return off < band;
  }

  const Delaunay& delaunay_;
  TiedStar& star_;
};

}  // namespace

TiedStar tiedStar(int p, const Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>& plane,
                  const std::vector<int>& ranks) {
  Delaunay delaunay;
  const auto origin = delaunay.insert(Kernel::Point_2(0, 0));
  origin->info() = p;
  for (Eigen::Index i = 0; i < plane.rows(); ++i) {
    const std::size_t before = delaunay.number_of_vertices();
    const auto vertex = delaunay.insert(Kernel::Point_2(plane(i, 0), plane(i, 1)));
    if (delaunay.number_of_vertices() > before) vertex->info() = ranks[i];
  }
  TiedStar star;
  if (delaunay.dimension() < 2) return star;
  star.closed = true;
  TiedCells cells(delaunay, star);
  std::set<std::array<int, 2>> found;
  const auto first = delaunay.incident_faces(origin);
  auto face = first;
  do {
    if (delaunay.is_infinite(face)) {
      star.closed = false;
      continue;
    }
    auto polygon = cells.cellOf(face);
    std::rotate(polygon.begin(), std::find(polygon.begin(), polygon.end(), origin), polygon.end());
    std::vector<int> others;
    for (std::size_t i = 1; i < polygon.size(); ++i) others.push_back(polygon[i]->info());
    const int least = *std::min_element(others.begin(), others.end());
    // The fan around the smallest rank: around p itself, or the two triangles at p on both sides of the edge to it.
    if (p > least) others = {others.front(), least, others.back()};
    for (std::size_t i = 0; i + 1 < others.size(); ++i)
      if (others[i] != others[i + 1]) found.insert({others[i], others[i + 1]});
  } while (++face != first);
  star.triangles.assign(found.begin(), found.end());
  return star;
}

}  // namespace tufted::attacks
