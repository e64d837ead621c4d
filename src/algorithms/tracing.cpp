// GeodesicTracer: straightest geodesics over triangles.
#include "tufted/tracing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/geodesic_step.h"
#include "algorithms/heat_sources.h"
#include "algorithms/march_faces.h"
#include "algorithms/strip.h"
#include "base/cross.h"
#include "operators/corners_in_range.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

using Eigen::RowVector3d;
using Eigen::Vector2d;

constexpr const char* tracing_constructor = "GeodesicTracer";
constexpr const char* tracing_query = "GeodesicTracer::query";
constexpr const char* direction_name = "GeodesicTracer::query: direction";
/// A line ends after this many crossings, whose points fill 24 MB: a thousand times around a mesh of a million
/// triangles.
constexpr int most_crossings = 1'000'000;
/// Crossings between two calls of `progress`.
constexpr int crossings_between_reports = 65536;
/// Cosines that differ by less are equal but for rounding: both triangles at an edge meet a direction along it.
constexpr double same_cosine = 1e-14;

std::vector<DistinctFace> usableFaces(const PointsRef& points, const TrianglesRef& triangles) {
  std::vector<DistinctFace> faces;
  faces.reserve(static_cast<std::size_t>(triangles.rows()));
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    const std::array<int, 3> corners = {triangles(f, 0), triangles(f, 1), triangles(f, 2)};
    const auto& [a, b, c] = corners;
    const auto length = [&](int i, int j) { return (points.row(i) - points.row(j)).stableNorm(); };
    const std::array<double, 3> opposite = {length(b, c), length(c, a), length(a, b)};
    const bool is_finite = std::isfinite(opposite[0]) && std::isfinite(opposite[1]) && std::isfinite(opposite[2]);
    if (a != b && b != c && c != a && is_finite) faces.push_back(distinctFace(corners, opposite));
  }
  mergeCopies(faces);
  return faces;
}

MarchFaces facesOf(const PointsRef& points, const TrianglesRef& triangles) {
  std::vector<DistinctFace> faces = usableFaces(points, triangles);
  const int exponent = unitOf(faces);
  return marchFaces(std::move(faces), static_cast<int>(points.rows()), exponent, 0, Workers(1, {}));
}

/// Coordinates in a frame.
Vector2d inFrame(const Frames& frames, int point, const RowVector3d& vector) {
  const RowVector3d normal = frames.normals.row(point), x = frames.tangents.row(point);
  return {x.dot(vector), normal.cross(x).dot(vector)};
}

/// Where a line starts: at a vertex, or in a face.
struct Beginning {
  int vertex = -1, face = -1;
  std::array<double, 3> weights = {};  ///< by the corners of the face
};

}  // namespace

const char* nameOf(TraceEnd reason) {
  constexpr const char* names[] = {"length", "rim", "branch", "crossings"};
  return names[static_cast<int>(reason)];
}

struct GeodesicTracer::State {
  MarchFaces faces;
  Points points;
  Frames frames;

  RowVector3d offset(int from, int to) const {
    const PowerOfTwo unit(-faces.exponent);
    return scaledPosition(points.row(to), unit) - scaledPosition(points.row(from), unit);
  }
  bool isRim(int slot) const {
    const int edge = faces.edgeAt(slot);
    return faces.edge_offset[edge + 1] - faces.edge_offset[edge] == 1;
  }
  RowVector3d place(int face, const std::array<double, 3>& weights) const;
  RowVector3d headingOf(const FaceAhead& ahead) const;
  SurfacePoint pointIn(int face, const std::array<double, 3>& weights) const;
  Beginning located(const SurfacePoint& start) const;
  FaceAhead startInFace(const Beginning& start, const RowVector3d& direction) const;
  std::optional<FaceAhead> startAtVertex(int vertex, const Vector2d& heading) const;
  std::optional<FaceAhead> begin(const SurfacePoint& start, const RowVector3d& direction, TracedLine& result) const;
  std::optional<FaceAhead> beyond(const FaceAhead& ahead, const Leaving& leaving, TraceEnd& reason) const;
};

GeodesicTracer::GeodesicTracer(const PointsRef& points, const TrianglesRef& triangles, const Frames& frames) {
  const auto require = [&](const char* name, const Points& array) {
    if (array.rows() != points.rows())
      throw InvalidInput(std::string(tracing_constructor) + ": frames." + name + " has " +
                         std::to_string(array.rows()) + " rows, must have " + std::to_string(points.rows()));
  };
  require("normals", frames.normals);
  require("tangents", frames.tangents);
  requireCornersInRange(tracing_constructor, triangles, points.rows());
  state_.reset(new State{facesOf(points, triangles), points, frames});
}

RowVector3d GeodesicTracer::State::place(int face, const std::array<double, 3>& weights) const {
  RowVector3d sum = RowVector3d::Zero();
  for (int k = 0; k < 3; ++k)
    if (weights[k] != 0) sum += weights[k] * points.row(faces.faces[face].corners[k]);
  return sum;
}

/// The x axis of the plane of a face as a unit vector in space; 0 for a face without area.
RowVector3d GeodesicTracer::State::headingOf(const FaceAhead& ahead) const {
  const auto& [a, b, c] = faces.faces[ahead.face].corners;
  const Vector2d first = ahead.corners[1] - ahead.corners[0], second = ahead.corners[2] - ahead.corners[0];
  const RowVector3d along = second.y() * offset(a, b) - first.y() * offset(a, c);
  return (cross(first, second) < 0 ? -along : along).stableNormalized();
}

SurfacePoint GeodesicTracer::State::pointIn(int face, const std::array<double, 3>& weights) const {
  const auto& [a, b, c] = faces.faces[face].corners;
  return SurfacePoint::inFace(points, Triangles{{a, b, c}}, 0, weights);
}

Beginning GeodesicTracer::State::located(const SurfacePoint& start) const {
  std::array<std::pair<int, double>, 3> parts;
  for (int k = 0; k < 3; ++k) {
    parts[k] = {start.corners[k], start.weights[k]};
    if (start.corners[k] < 0 || start.corners[k] >= points.rows())
      throw InvalidInput(std::string(tracing_query) + ": start = " + std::to_string(start.corners[k]) +
                         ", must lie in [0, " + std::to_string(points.rows()) + ")");
    if (start.weights[k] != 1) continue;
    const int vertex = start.corners[k];
    if (faces.corner_offset[vertex] == faces.corner_offset[vertex + 1])
      throw InvalidInput(std::string(tracing_query) + ": start = " + std::to_string(vertex) +
                         " is in no triangle, must be in one");
    return {.vertex = vertex};
  }
  std::sort(parts.begin(), parts.end());
  const std::array<int, 3> corners = {parts[0].first, parts[1].first, parts[2].first};
  const auto found = std::lower_bound(faces.faces.begin(), faces.faces.end(), corners,
                                      [](const MarchFace& face, const auto& sought) { return face.corners < sought; });
  if (found == faces.faces.end() || found->corners != corners)
    throw InvalidInput(std::string(tracing_query) + ": start lies in the triangle " + std::to_string(corners[0]) + " " +
                       std::to_string(corners[1]) + " " + std::to_string(corners[2]) +
                       ", must lie in a triangle of the surface");
  return {.face = static_cast<int>(found - faces.faces.begin()),
          .weights = {parts[0].second, parts[1].second, parts[2].second}};
}

FaceAhead GeodesicTracer::State::startInFace(const Beginning& start, const RowVector3d& direction) const {
  const auto& [a, b, c] = faces.faces[start.face].corners;
  const RowVector3d first = offset(a, b), second = offset(a, c), normal = first.cross(second).stableNormalized();
  if (normal.isZero(0))
    throw InvalidInput(std::string(tracing_query) + ": the triangle of start has no area, must have");
  const Frames frame{normal, first.stableNormalized(), Orientation::arbitrary};
  const Vector2d heading = inTangentPlane(direction_name, frame, 0, direction).stableNormalized();
  const RowVector3d origin = start.weights[1] * first + start.weights[2] * second;
  const std::array<RowVector3d, 3> corners = {-origin, first - origin, second - origin};
  FaceAhead ahead{start.face, {}, start.weights};
  for (int k = 0; k < 3; ++k) {
    const Vector2d corner = inFrame(frame, 0, corners[k]);
    ahead.corners[k] = Vector2d(heading.dot(corner), cross(heading, corner));
  }
  return ahead;
}

/// @param heading unit vector in the frame of the vertex
/// @returns nullopt if it leads off the surface
std::optional<FaceAhead> GeodesicTracer::State::startAtVertex(int vertex, const Vector2d& heading) const {
  FanCorner best = {-1, -1, -1};
  double angle = 0, best_cosine = -1, best_slope = 0;
  bool has_rim = false;
  for (int i = faces.corner_offset[vertex]; i < faces.corner_offset[vertex + 1]; ++i) {
    const int slot = faces.corner_slots[i];
    const FanCorner corner = {slot, nextSide(slot), previousSide(slot)};
    has_rim |= isRim(corner.from) || isRim(corner.to);
    const RowVector3d from = offset(vertex, faces.vertexAt(corner.from)),
                      to = offset(vertex, faces.vertexAt(corner.to));
    const Vector2d flat_from = inFrame(frames, vertex, from), flat_to = inFrame(frames, vertex, to);
    // The heading by the sides of the triangle, or the side nearest to it.
    const double area = cross(flat_from, flat_to);
    const double by_from = std::max(cross(heading, flat_to) / area, 0.0);
    const double by_to = std::max(cross(flat_from, heading) / area, 0.0);
    const Vector2d flat = by_from * flat_from + by_to * flat_to;
    if (flat.isZero(0)) continue;  // the heading is on the other side
    const RowVector3d tilted = by_from * from + by_to * to;
    const double cosine = heading.dot(flat.normalized()), slope = tilted.norm() / flat.norm();
    const bool is_nearer = cosine > best_cosine + same_cosine;
    if (!is_nearer && !(cosine > best_cosine - same_cosine && slope < best_slope)) continue;
    best = corner;
    angle = std::atan2(from.cross(tilted).norm(), from.dot(tilted));
    best_cosine = cosine;
    best_slope = slope;
  }
  if (best.slot < 0 || (has_rim && best_cosine < 1 - same_cosine)) return {};
  return startAt(faces, best, angle);
}

/// The face in which a line starts; nullopt if it leads off the surface at a vertex, where it ends as the result says.
std::optional<FaceAhead> GeodesicTracer::State::begin(const SurfacePoint& start, const RowVector3d& direction,
                                                      TracedLine& result) const {
  const Beginning beginning = located(start);
  if (beginning.vertex < 0) return startInFace(beginning, direction);
  const int vertex = beginning.vertex;
  const Vector2d heading = inTangentPlane(direction_name, frames, vertex, direction).stableNormalized();
  const RowVector3d x = frames.tangents.row(vertex), y = RowVector3d(frames.normals.row(vertex)).cross(x);
  result.end = SurfacePoint::vertex(vertex);
  result.direction = heading.x() * x + heading.y() * y;
  result.reason = TraceEnd::rim;
  return startAtVertex(vertex, heading);
}

/// The face after a place where a line leaves a face; nullopt and why, if there is none.
std::optional<FaceAhead> GeodesicTracer::State::beyond(const FaceAhead& ahead, const Leaving& leaving,
                                                       TraceEnd& reason) const {
  int open = leaving.slot;
  std::optional<FaceAhead> next;
  if (leaving.is_corner)
    next = passVertex(faces, ahead, leaving, open);
  else if (mateOf(faces, leaving.slot) >= 0)
    next = crossSide(faces, ahead, leaving);
  if (!next) reason = isRim(open) ? TraceEnd::rim : TraceEnd::branch;
  return next;
}

TracedLine GeodesicTracer::query(const SurfacePoint& start, const RowVector3d& direction, double length,
                                 const Progress& progress) const {
  const State& state = *state_;
  if (!direction.allFinite() || direction.isZero(0))
    throw InvalidInput(std::string(direction_name) + " is not finite or 0, must be a direction");
  if (!(length >= 0) || !std::isfinite(length))
    throw InvalidInput(std::string(tracing_query) + ": length = " + std::to_string(length) +
                       ", must be >= 0 and finite");
  const Workers workers(1, progress);
  TracedLine result;
  std::optional<FaceAhead> ahead = state.begin(start, direction, result);
  std::vector<RowVector3d> places = {ahead ? state.place(ahead->face, ahead->weights)
                                           : RowVector3d(state.points.row(result.end.corners[0]))};
  const double whole = std::ldexp(length, -state.faces.exponent);
  double travelled = 0;
  for (int crossings = 0; ahead; ++crossings) {
    if (crossings % crossings_between_reports == 0) workers.report("trace", 0);
    const Leaving leaving = leavingOf(*ahead);
    const double left = whole - travelled, share = left < leaving.distance ? left / leaving.distance : 1;
    std::array<double, 3> weights;
    for (int k = 0; k < 3; ++k) weights[k] = (1 - share) * ahead->weights[k] + share * leaving.weights[k];
    if (const RowVector3d at = state.place(ahead->face, weights); at != places.back()) places.push_back(at);
    result.reason = crossings == most_crossings ? TraceEnd::crossings : TraceEnd::length;
    const bool is_end = left <= leaving.distance || crossings == most_crossings;
    travelled += std::min(left, leaving.distance);
    const std::optional<FaceAhead> next = is_end ? std::nullopt : state.beyond(*ahead, leaving, result.reason);
    if (!next) {
      result.end = state.pointIn(ahead->face, weights);
      result.direction = state.headingOf(*ahead);
    }
    ahead = next;
  }
  result.line.length = result.reason == TraceEnd::length ? length : std::ldexp(travelled, state.faces.exponent);
  result.line.points = Eigen::Map<const Points>(places.front().data(), std::ssize(places), 3);
  return result;
}

}  // namespace tufted
