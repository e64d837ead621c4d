#include "algorithms/exact_log_map.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>

#include "base/parallel.h"
#include "cover/geometry.h"
#include "operators/distinct_faces.h"
#include "tufted/surface_triangles.h"

namespace tufted {
namespace {

/// Triangles as a surface: sides without a mate, or whose mate would run the same way, are glued to -1.
/// @param triangles at most two at an edge
IntrinsicTriangulation glued(const Points& positions, const Triangles& triangles) {
  IntrinsicTriangulation surface;
  surface.vertices = static_cast<int>(positions.rows());
  std::vector<std::array<int, 3>> edges;  // smaller end, larger end, side
  for (int f = 0; f < triangles.rows(); ++f) {
    surface.faces.push_back({triangles(f, 0), triangles(f, 1), triangles(f, 2)});
    for (int k = 0; k < 3; ++k) {
      const int a = triangles(f, k), b = triangles(f, (k + 1) % 3);
      surface.length.push_back((positions.row(a) - positions.row(b)).stableNorm());
      edges.push_back({std::min(a, b), std::max(a, b), 3 * f + k});
    }
  }
  std::sort(edges.begin(), edges.end());
  surface.glue.assign(edges.size(), -1);
  for (std::size_t i = 1; i < edges.size(); ++i) {
    const auto &one = edges[i - 1], &other = edges[i];
    if (one[0] != other[0] || one[1] != other[1] || tail(surface, one[2]) == tail(surface, other[2])) continue;
    surface.glue[one[2]] = other[2];
    surface.glue[other[2]] = one[2];
  }
  return surface;
}

}  // namespace

ExactLogMap::ExactLogMap(const Laplacian& laplacian, const Frames& frames, const Progress& progress)
    : L_(laplacian.L),
      positions_(laplacian.positions),
      frames_(frames),
      components_(findComponents(laplacian)),
      exponent_(unitOf(*laplacian.cover_source)) {
  if (laplacian.kind == Kind::cloud && laplacian.frames.normals.rows() > 0)
    triangles_ = glued(positions_, surfaceTriangles(laplacian, {.progress = progress}));
  else
    cover_ = laplacian.cover_source;
}

std::size_t ExactLogMap::bytes() const {
  const auto values = static_cast<std::size_t>(positions_.size() + frames_.normals.size() + frames_.tangents.size());
  return static_cast<std::size_t>(L_.nonZeros()) * (sizeof(double) + sizeof(int)) + values * sizeof(double) +
         triangles_.faces.size() * (6 * sizeof(int) + 3 * sizeof(double));
}

Eigen::Vector2d ExactLogMap::inPlane(int source, const Eigen::RowVector3d& offset) const {
  const Eigen::RowVector3d normal = frames_.normals.row(source), x = frames_.tangents.row(source);
  return {x.dot(offset), normal.cross(x).dot(offset)};
}

/// The direction in the tangent plane in which a line leaves a source, as GeodesicTracer starts it: the line runs to a
/// place on the opposite side of the triangle, which is projected.
/// @param angle of the line from the sector's side
double ExactLogMap::angleAlong(int source, const Sector& sector, double angle) const {
  const int right = sector.side, left = previousSide(sector.side);
  const double by_right = surface().length[left] * std::sin(sector.angle - angle),
               by_left = surface().length[right] * std::sin(angle), sum = by_right + by_left;
  const double share = sum > 0 ? by_left / sum : 0;
  const Eigen::RowVector3d to_right = positions_.row(head(surface(), right)) - positions_.row(source),
                           to_left = positions_.row(tail(surface(), left)) - positions_.row(source);
  const Eigen::Vector2d flat = inPlane(source, (1 - share) * to_right + share * to_left);
  return std::atan2(flat.y(), flat.x());
}

/// The directions in the tangent plane of all turns.
std::vector<double> ExactLogMap::anglesOf(int source, const GeodesicWindows& windows) const {
  const std::vector<Sector>& sectors = windows.sectors();
  std::vector<double> angles(static_cast<std::size_t>(positions_.rows()), 0);
  for (int i = 0; i < static_cast<int>(angles.size()); ++i) {
    if (i == source || !std::isfinite(windows.distance(i))) continue;
    const double turn = windows.turn(i);
    const Sector& sector = *std::prev(std::upper_bound(sectors.begin() + 1, sectors.end(), turn,
                                                       [](double t, const Sector& s) { return t < s.begin; }));
    angles[i] = angleAlong(source, sector, std::clamp(turn - sector.begin, 0.0, sector.angle));
  }
  return angles;
}

/// Extends the result to points of the component that lie in no triangle of the surface: along the edges of L, with the
/// direction of the point that they are reached from.
void ExactLogMap::extend(int source, Result& result) const {
  const auto isOpen = [&](int i) {
    return components_.of[i] == components_.of[source] && !std::isfinite(result.distance[i]);
  };
  if (std::none_of(components_.points.begin(), components_.points.end(), isOpen)) return;
  using Way = std::tuple<double, int, double>;  // length, point, angle
  std::priority_queue<Way, std::vector<Way>, std::greater<>> ways;
  const auto offerNeighbors = [&](int p) {
    for (SparseMatrix::InnerIterator entry(L_, p); entry; ++entry) {
      const auto q = static_cast<int>(entry.row());
      if (!isOpen(q)) continue;
      const Eigen::RowVector3d offset = positions_.row(q) - positions_.row(p);
      const Eigen::Vector2d flat = inPlane(source, offset);
      ways.emplace(result.distance[p] + offset.stableNorm(), q,
                   p == source ? std::atan2(flat.y(), flat.x()) : result.angle[p]);
    }
  };
  for (const int p : components_.points)
    if (std::isfinite(result.distance[p])) offerNeighbors(p);
  while (!ways.empty()) {
    const auto [length, point, angle] = ways.top();
    ways.pop();
    if (!isOpen(point)) continue;
    result.distance[point] = length;
    result.angle[point] = angle;
    offerNeighbors(point);
  }
}

ExactLogMap::Result ExactLogMap::query(int source, const Progress& progress) const {
  const GeodesicWindows windows(surface(), exponent_, source, Workers(1, progress));
  const std::vector<double> angles = anglesOf(source, windows);
  Result result{VectorXd(positions_.rows()), VectorXd(positions_.rows())};
  for (Eigen::Index i = 0; i < positions_.rows(); ++i) {
    const bool is_joined = components_.of[i] == components_.of[source];
    result.distance[i] = is_joined ? windows.distance(static_cast<int>(i)) : std::numeric_limits<double>::infinity();
    result.angle[i] = angles[i];
  }
  extend(source, result);
  return result;
}

}  // namespace tufted
