#include "tufted/polygons.h"

#include <array>
#include <stdexcept>
#include <string>

#include "base/parallel.h"
#include "polygons/ear_clipper.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

constexpr std::size_t most_corners = std::size_t{1} << 30;  // two trees number them by int

/// Checks the polygons; returns the number of triangles.
Eigen::Index checkedTriangles(const Points& points, const Polygons& polygons) {
  Eigen::Index triangles = 0;
  for (std::size_t p = 0; p < polygons.size(); ++p) {
    if (polygons[p].size() > most_corners) throw std::length_error("triangulate: more than 2^30 vertices");
    for (const int vertex : polygons[p]) {
      if (vertex < 0 || vertex >= points.rows()) {
        throw InvalidInput("triangulate: polygon " + std::to_string(p) + " names vertex " + std::to_string(vertex) +
                           ", must lie in [0, " + std::to_string(points.rows()) + ")");
      }
    }
    if (polygons[p].size() >= 3) triangles += static_cast<Eigen::Index>(polygons[p].size()) - 2;
  }
  return triangles;
}

}  // namespace

Triangles triangulate(const Points& points, const Polygons& polygons, const Progress& progress) {
  // Triangles from one report of progress to the next.
  constexpr Eigen::Index report_every = 4096;
  const Workers workers(1, progress);
  Triangles triangles(checkedTriangles(points, polygons), 3);
  EarClipper clipper;
  Eigen::Index done = 0;
  for (const std::vector<int>& polygon : polygons) {
    if (polygon.size() > 3) clipper.begin(points, polygon);
    for (std::size_t t = 2; t < polygon.size(); ++t, ++done) {
      if (done % report_every == 0)
        workers.report("triangulate", static_cast<double>(done) / static_cast<double>(triangles.rows()));
      const std::array<int, 3> corners = polygon.size() > 3 ? clipper.next() : std::array<int, 3>{0, 1, 2};
      triangles.row(done) << polygon[corners[0]], polygon[corners[1]], polygon[corners[2]];
    }
  }
  return triangles;
}

}  // namespace tufted
