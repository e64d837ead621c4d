#include "algorithms/curve_sides.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "tufted/signed_distance.h"

namespace tufted {
namespace {

using Eigen::RowVector3d;

/// Distances from two segments that differ by less than this part of their lengths are equal but for rounding: they
/// are from the end that both segments share.
constexpr double shared_end = 1e-9;

/// The nearest source to a point next to a curve.
struct NearestSource {
  double distance = std::numeric_limits<double>::infinity();
  double height = 0;  ///< over the line through the nearest segment, positive on its left
};

std::set<int> cornersOf(const CurvePlace& place) {
  std::set<int> corners;
  for (int k = 0; k < 3; ++k)
    if (place.point.weights[k] > 0) corners.insert(place.point.corners[k]);
  return corners;
}

class CurveSides {
 public:
  CurveSides(const SideGeometry& surface, VectorXd& distance)
      : surface_(surface), distance_(distance), nearest_(static_cast<std::size_t>(distance.size())) {}

  void add(const CurveSegment& segment) {
    std::set<int> corners = cornersOf(segment.from), near;
    corners.merge(cornersOf(segment.to));
    if (const auto middle = middleInTriangle(segment, surface_.positions))
      corners.insert(middle->corners.begin(), middle->corners.end());
    for (const int i : corners) forNeighbors(i, [&](int j) { near.insert(j); });
    for (const int i : near) {
      const double distance = look(segment, i);
      if (isCornerAround(corners, i)) distance_[i] = std::min(distance_[i], distance);
    }
  }

  void add(const CurvePlace& place) {
    for (const int i : cornersOf(place)) {
      forNeighbors(i, [&](int j) {
        const double distance = (surface_.positions.row(j) - place.position).stableNorm();
        if (distance < nearest_[j].distance) nearest_[j] = {distance, distance};
      });
    }
  }

  void finish() {
    std::vector<int> order;
    for (const int i : surface_.components.points)
      if (std::isfinite(distance_[i])) order.push_back(i);
    std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return distance_[i] < distance_[j]; });
    // In [-1, 1]; next to a curve the sine of the angle between the shortest path and the line through the segment.
    VectorXd side = VectorXd::Zero(distance_.size());
    for (const int i : order) {
      if (distance_[i] == 0) continue;
      double sum = nearest_[i].height, weight = nearest_[i].distance;
      if (!(weight < std::numeric_limits<double>::infinity())) {
        sum = weight = 0;
        for (SparseMatrix::InnerIterator entry(surface_.L, i); entry; ++entry) {
          const double share = std::max(distance_[i] - distance_[entry.row()], 0.) * std::abs(entry.value());
          sum += share * side[entry.row()];
          weight += share;
        }
      }
      side[i] = weight > 0 ? std::clamp(sum / weight, -1., 1.) : 0;
    }
    for (const int i : order)
      if (side[i] < 0) distance_[i] = -distance_[i];
  }

 private:
  /// Visits a point and its neighbours.
  template <class Visit>
  void forNeighbors(int i, const Visit& visit) const {
    for (SparseMatrix::InnerIterator entry(surface_.L, i); entry; ++entry)
      if (entry.value() != 0) visit(static_cast<int>(entry.row()));
  }

  /// Whether a point is a corner of the triangle around a segment: one of its three corners or, of a segment between
  /// two vertices, a neighbour of both.
  bool isCornerAround(const std::set<int>& corners, int i) const {
    if (corners.size() != 2) return corners.size() == 3 && corners.count(i) > 0;
    return std::all_of(corners.begin(), corners.end(), [&](int end) { return surface_.L.coeff(i, end) != 0; });
  }

  /// Compares a segment with the nearest one to a point so far. Of two that meet in the nearest place, the one counts
  /// whose line is farther away: the point lies beyond the end of the other.
  /// @return the distance of the segment
  double look(const CurveSegment& segment, int i) {
    const RowVector3d offset = surface_.positions.row(i) - segment.from.position;
    const RowVector3d normal = normalBetween(segment, i);
    const double foot = std::clamp(offset.dot(segment.along), 0., segment.length);
    const double distance = (offset - foot * segment.along).stableNorm();
    const double height = normal.cross(segment.along).dot(offset);
    NearestSource& best = nearest_[i];
    const double rounding = shared_end * segment.length;
    if (distance < best.distance - rounding ||
        (distance < best.distance + rounding && std::abs(height) > std::abs(best.height)))
      best = {distance, height};
    return distance;
  }

  /// The mean of the normals of a point and of both ends of a segment: over a sharp edge that of the point alone may be
  /// perpendicular to that of the surface at the segment.
  RowVector3d normalBetween(const CurveSegment& segment, int i) const {
    RowVector3d sum = surface_.frames.normals.row(i);
    for (const CurvePlace* end : {&segment.from, &segment.to})
      for (int k = 0; k < 3; ++k)
        if (end->point.weights[k] > 0)
          sum += end->point.weights[k] * surface_.frames.normals.row(end->point.corners[k]);
    return sum.norm() > 0 ? RowVector3d(sum.normalized()) : sum;
  }

  const SideGeometry& surface_;
  VectorXd& distance_;
  std::vector<NearestSource> nearest_;
};

/// The weights of a place by corners of a triangle; empty if it does not lie in the triangle.
std::optional<Eigen::Vector3d> weightsIn(const std::array<int, 3>& triangle, const CurvePlace& place) {
  Eigen::Vector3d weights = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    if (!(place.point.weights[k] > 0)) continue;
    const auto corner = std::find(triangle.begin(), triangle.end(), place.point.corners[k]);
    if (corner == triangle.end()) return std::nullopt;
    weights[corner - triangle.begin()] += place.point.weights[k];
  }
  return weights;
}

}  // namespace

bool skipsPoints(const CurveSegment& segment, const SparseMatrix& L, const Points& positions) {
  double longest[2] = {0, 0};
  for (const int end : {0, 1})
    for (const int i : (end == 0 ? segment.from : segment.to).point.corners)
      for (SparseMatrix::InnerIterator entry(L, i); entry; ++entry)
        longest[end] = std::max(longest[end], (positions.row(entry.row()) - positions.row(i)).stableNorm());
  return segment.length > longest[0] + longest[1];
}

std::optional<SurfacePoint> middleInTriangle(const CurveSegment& segment, const Points& positions) {
  for (const CurvePlace* place : {&segment.from, &segment.to}) {
    const auto from = weightsIn(place->point.corners, segment.from), to = weightsIn(place->point.corners, segment.to);
    if (!from || !to) continue;
    SurfacePoint middle = place->point;
    const Eigen::RowVector3d position = segment.from.position + segment.length / 2 * segment.along;
    for (int k = 0; k < 3; ++k) {
      middle.weights[k] = ((*from)[k] + (*to)[k]) / 2;
      middle.distances[k] = (position - positions.row(middle.corners[k])).stableNorm();
    }
    return middle;
  }
  return std::nullopt;
}

void signBySide(const SideGeometry& surface, const std::vector<CurveSegment>& segments,
                const std::vector<CurvePlace>& places, VectorXd& distance) {
  CurveSides sides(surface, distance);
  for (const CurveSegment& segment : segments) sides.add(segment);
  for (const CurvePlace& place : places) sides.add(place);
  sides.finish();
}

std::string longSegmentsWarning(const SignedDistanceReport& report) {
  if (report.long_segments == 0) return {};
  return std::to_string(report.long_segments) + " of the " + std::to_string(report.segments) +
         " segments of the curves are longer than the edges at both ends together, and the points between their ends " +
         "do not count as parts of the curves; take paths between the ends";
}

}  // namespace tufted
