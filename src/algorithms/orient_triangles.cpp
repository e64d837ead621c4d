#include "algorithms/orient_triangles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>

#include "base/sort_by_number.h"

namespace tufted {
namespace {

using Triangle = std::array<int, 3>;

/// If the volume of a component over its area and size is smaller than this, it is rounding, and the mean normal
/// decides.
constexpr double rounded_volume = 1e-6;

/// A side of a triangle, by its ends.
struct TriangleSide {
  int low, high;
  int triangle;
  bool ascends;  ///< whether the side runs from `low` to `high`
};

/// The triangle across an inner edge.
struct AdjacentTriangle {
  int triangle = -1;
  bool agrees = true;  ///< whether the two triangles' sides have opposite directions
};

/// The neighbours of each triangle across its inner edges.
/// @param points number of points
std::vector<std::array<AdjacentTriangle, 3>> neighborsOf(const std::vector<Triangle>& triangles, std::size_t points,
                                                         TriangleReport& report) {
  std::vector<TriangleSide> sides;
  sides.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int a = triangles[t][k], b = triangles[t][(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), static_cast<int>(t), a < b});
    }
  }
  sortByNumber(
      sides, points, [](const TriangleSide& side) { return side.low; },
      [](const TriangleSide& a, const TriangleSide& b) {
        return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
      });
  std::vector<std::array<AdjacentTriangle, 3>> neighbors(triangles.size());
  const auto join = [&](const TriangleSide& from, const TriangleSide& to) {
    for (AdjacentTriangle& place : neighbors[from.triangle]) {
      if (place.triangle >= 0) continue;
      place = {to.triangle, from.ascends != to.ascends};
      return;
    }
  };
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const bool is_inner =
        s + 1 < sides.size() && sides[s].low == sides[s + 1].low && sides[s].high == sides[s + 1].high;
    if (!is_inner) {
      ++report.open_edges;
      continue;
    }
    ++report.inner_edges;
    join(sides[s], sides[s + 1]);
    join(sides[s + 1], sides[s]);
    ++s;
  }
  return neighbors;
}

/// Whether the triangles of one component must be reversed.
bool isInsideOut(const Laplacian& laplacian, const std::vector<Triangle>& triangles,
                 const std::vector<int>& component) {
  const Points& positions = laplacian.positions;
  const Eigen::RowVector3d origin = positions.row(triangles[component.front()][0]);
  double size = 0;
  for (const int t : component)
    for (const int corner : triangles[t]) size = std::max(size, (positions.row(corner) - origin).cwiseAbs().maxCoeff());
  if (!(size > 0)) return false;
  const auto place = [&](int corner) { return Eigen::RowVector3d((positions.row(corner) - origin) / size); };
  Eigen::RowVector3d centre = Eigen::RowVector3d::Zero(), mean = centre;
  double area = 0, agreement = 0;
  for (const int t : component) {
    const auto& [a, b, c] = triangles[t];
    const Eigen::RowVector3d normal = (place(b) - place(a)).cross(place(c) - place(a));
    mean += normal;
    area += normal.norm();
    centre += normal.norm() * (place(a) + place(b) + place(c)) / 3;
    for (const int corner : triangles[t]) agreement += normal.dot(laplacian.frames.normals.row(corner));
  }
  if (laplacian.frames.orientation != Orientation::arbitrary) return agreement < 0;
  if (!(area > 0)) return false;
  centre /= area;
  double volume = 0;
  for (const int t : component) {
    const auto& [a, b, c] = triangles[t];
    volume += (place(b) - place(a)).cross(place(c) - place(a)).dot(place(a) - centre);
  }
  if (std::abs(volume) > rounded_volume * area) return volume < 0;
  int axis = 0;
  mean.cwiseAbs().maxCoeff(&axis);
  return mean[axis] < 0;
}

}  // namespace

void orientTriangles(const Laplacian& laplacian, std::vector<Triangle>& triangles, TriangleReport& report) {
  const std::vector<std::array<AdjacentTriangle, 3>> neighbors =
      neighborsOf(triangles, laplacian.status.size(), report);
  const auto turn = [](Triangle& corners) { std::swap(corners[1], corners[2]); };
  std::vector<std::uint8_t> seen(triangles.size(), 0), turned(triangles.size(), 0);
  std::vector<int> component;
  for (std::size_t first = 0; first < triangles.size(); ++first) {
    if (seen[first] != 0) continue;
    ++report.components;
    seen[first] = 1;
    component.assign(1, static_cast<int>(first));
    for (std::size_t k = 0; k < component.size(); ++k) {
      const int t = component[k];
      for (const AdjacentTriangle& neighbor : neighbors[t]) {
        if (neighbor.triangle < 0) continue;
        const std::uint8_t wanted = turned[t] ^ (neighbor.agrees ? 0 : 1);
        if (seen[neighbor.triangle] != 0) {
          // Each edge is visited from both sides, but counted once.
          if (turned[neighbor.triangle] != wanted && t < neighbor.triangle) ++report.disagreeing_edges;
          continue;
        }
        seen[neighbor.triangle] = 1;
        turned[neighbor.triangle] = wanted;
        component.push_back(neighbor.triangle);
      }
    }
    for (const int t : component)
      if (turned[t] != 0) turn(triangles[t]);
    if (isInsideOut(laplacian, triangles, component))
      for (const int t : component) turn(triangles[t]);
  }
}

}  // namespace tufted
