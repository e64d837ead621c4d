#include "algorithms/marching_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <tuple>

#include "algorithms/apex.h"
#include "algorithms/march.h"
#include "base/parallel.h"
#include "base/stage_clock.h"

namespace tufted {
namespace {

/// A source nearer to a side than this part of the longest side counts as on it, and starts in all faces that meet
/// there.
constexpr double on_side = 1e-9;

using Plane = std::array<Eigen::Vector2d, 3>;

/// The corners of a face in its plane.
Plane layOut(const MarchFace& face) {
  const auto& [a, b, c] = face.opposite;
  const Eigen::Vector2d first(0, 0), second(c, 0);
  return {first, second, apexLeftOf(first, second, b, a, face.doubleArea())};
}

/// The numbers of the sources without repeated ones.
std::vector<int> firstOfEach(const std::vector<SurfacePoint>& sources) {
  std::vector<int> number(sources.size());
  std::iota(number.begin(), number.end(), 0);
  const auto place = [&](int s) { return std::tie(sources[s].corners, sources[s].weights, sources[s].distances); };
  std::stable_sort(number.begin(), number.end(), [&](int s, int t) { return place(s) < place(t); });
  number.erase(std::unique(number.begin(), number.end(), [&](int s, int t) { return place(s) == place(t); }),
               number.end());
  return number;
}

bool hasCorner(const MarchFace& face, int vertex) {
  return std::find(face.corners.begin(), face.corners.end(), vertex) != face.corners.end();
}

}  // namespace

/// A whole face of the cover.
struct MarchingDistance::CoverFace {
  MarchFace face;                    ///< its `edges` are not set if cut twice
  std::array<int, 3> middle;         ///< vertex at the midpoint of each side, if cut
  std::span<const MarchFace> parts;  ///< its four stored parts, if cut twice
};

MarchingDistance::MarchingDistance(const Laplacian& laplacian, int split, const DistanceOptions& options)
    : number_(numbersByFaces(laplacian)),
      vertices_(static_cast<int>(laplacian.status.size())),
      split_(split),
      maximum_(options.maximum),
      threads_(options.solver.threads) {
  const Workers workers(threads_, options.solver.progress);
  faces_ = marchFaces(laplacian, split_, workers, number_);
  report_.method = "marching";
  report_.unknowns = std::int64_t{faces_.vertices} + (split_ > 0 ? faces_.edges : 0);
  report_.bytes = faces_.bytes() + bytesOf(number_);
}

/// The whole face that a stored face is or is part of.
MarchingDistance::CoverFace MarchingDistance::coverFace(int face) const {
  const MarchFace& stored = faces_.faces[face];
  CoverFace result = {stored, {}, {}};
  if (split_ < 2) {
    for (int k = 0; k < 3; ++k) result.middle[k] = vertices_ + stored.edges[k];
    return result;
  }
  // The parts are stored one after another: one at each corner, then the one between the midpoints.
  const MarchFace* const part = &faces_.faces[face / 4 * 4];
  result.parts = {part, 4};
  result.face.signed_area = 4 * part[3].doubleArea();
  const auto& middles = part[3].corners;
  for (int k = 0; k < 3; ++k) {
    // Corners of a part ascend, and vertices of the cover come before midpoints.
    result.face.corners[k] = part[k].corners[0];
    result.face.opposite[k] = 2 * part[k].opposite[0];
    const auto found =
        std::find_if(middles.begin(), middles.end(), [&](int middle) { return !hasCorner(part[k], middle); });
    // If two sides are one edge, its midpoint is twice in the last part, and in all others.
    result.middle[k] = found != middles.end() ? *found : middles[1];
  }
  return result;
}

/// Starts all vertices of a face that a source lies in, midpoints included, at their distance in its plane.
/// @param weights of the source, by corner of the face
void MarchingDistance::startIn(const CoverFace& whole, const std::array<double, 3>& weights, int source,
                               std::vector<MarchStart>& starts) const {
  const Plane corner = layOut(whole.face);
  Eigen::Vector2d point = Eigen::Vector2d::Zero();
  for (int k = 0; k < 3; ++k) point += weights[k] * corner[k];
  const auto middle = [](const Plane& plane, int k) -> Eigen::Vector2d {
    return (plane[(k + 1) % 3] + plane[(k + 2) % 3]) / 2;
  };
  for (int k = 0; k < 3; ++k) starts.push_back({whole.face.corners[k], (point - corner[k]).norm(), source});
  if (split_ == 0) return;
  for (int k = 0; k < 3; ++k) starts.push_back({whole.middle[k], (point - middle(corner, k)).norm(), source});
  for (int p = 0; p < std::ssize(whole.parts); ++p) {
    const std::array<int, 3>&ends = whole.parts[p].corners, &edges = whole.parts[p].edges;
    if (ends[0] == ends[1] || ends[1] == ends[2] || ends[2] == ends[0]) continue;
    Plane plane;
    for (int i = 0; i < 3; ++i) {
      int k = p == 0 ? 1 : 0;
      while (k < 2 && (k == p || whole.middle[k] != ends[i])) ++k;
      plane[i] = ends[i] < vertices_ ? corner[p] : middle(corner, k);
    }
    for (int i = 0; i < 3; ++i)
      starts.push_back({faces_.vertices + edges[i], (point - middle(plane, i)).norm(), source});
  }
}

/// Starts in the face of a place and, if it lies on a side, in all faces that meet there.
/// @param place inside a face, with corners numbered as in `faces_`
void MarchingDistance::startInFaces(const PlaceInCover& place, std::vector<MarchStart>& starts) const {
  // Corners of the place in the order of the face.
  std::array<int, 3> order = {0, 1, 2};
  std::array<double, 3> opposite, weights;
  for (int k = 0; k < 3; ++k) opposite[k] = std::ldexp(place.point.sides[k], -faces_.exponent);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return std::pair(place.point.corners[a], opposite[a]) < std::pair(place.point.corners[b], opposite[b]);
  });
  for (int k = 0; k < 3; ++k) weights[k] = place.point.weights[order[k]];
  const auto forFacesAt = [&](int vertex, const auto& visit) {
    for (int s = faces_.corner_offset[vertex]; s < faces_.corner_offset[vertex + 1]; ++s)
      visit(coverFace(faces_.corner_slots[s] / 3));
  };
  const auto isFaceOfPlace = [&](const MarchFace& face) {
    for (int k = 0; k < 3; ++k)
      if (face.corners[k] != place.point.corners[order[k]] || face.opposite[k] != opposite[order[k]]) return false;
    return true;
  };
  std::optional<CoverFace> home;
  forFacesAt(place.point.corners[order[0]], [&](const CoverFace& whole) {
    if (!home && isFaceOfPlace(whole.face)) home = whole;
  });
  if (!home) return;
  startIn(*home, weights, place.source, starts);
  const std::array<int, 3>& corners = home->face.corners;
  const std::array<double, 3>& sides = home->face.opposite;
  const double double_area = home->face.doubleArea();
  for (int k = 0; k < 3; ++k) {
    const int first = (k + 1) % 3, second = (k + 2) % 3;
    const double longest = *std::max_element(sides.begin(), sides.end());
    if (corners[first] == corners[second] || !(weights[k] * double_area <= on_side * longest * sides[k])) continue;
    forFacesAt(corners[first], [&](const CoverFace& other) {
      for (int j = 0; j < 3; ++j) {
        if (other.middle[j] != home->middle[k]) continue;
        std::array<double, 3> on_edge = {0, 0, 0};
        const int begin = other.face.corners[(j + 1) % 3] == corners[first] ? (j + 1) % 3 : (j + 2) % 3;
        on_edge[begin] = weights[first] / (weights[first] + weights[second]);
        on_edge[3 - j - begin] = 1 - on_edge[begin];
        startIn(other, on_edge, place.source, starts);
      }
    });
  }
}

void MarchingDistance::startAt(const PlaceInCover& place, const std::vector<int>& component,
                               std::vector<MarchStart>& starts) const {
  PlaceInCover numbered = place;
  bool all_active = true;
  for (int k = 0; k < 3; ++k) {
    const int corner = place.point.corners[k];
    numbered.point.corners[k] = number_[corner];
    all_active &= component[corner] >= 0;
    if (component[corner] >= 0)
      starts.push_back({number_[corner], std::ldexp(place.point.distances[k], -faces_.exponent), place.source});
  }
  if (all_active && place.face >= 0) startInFaces(numbered, starts);
}

SourcePositions MarchingDistance::positionsOf(const std::vector<SurfacePoint>& sources) const {
  SourcePositions positions;
  if (faces_.positions.empty()) return positions;
  for (const auto& [corners, weights, distances, sides] : sources) {
    const Eigen::Vector3d& first = faces_.positions[number_[corners[0]]];
    Eigen::Vector3d place = first;
    for (int k = 1; k < 3; ++k)
      if (weights[k] > 0) place += weights[k] * (faces_.positions[number_[corners[k]]] - first);
    positions.push_back(place);
  }
  return positions;
}

NearestSources MarchingDistance::query(const std::vector<SurfacePoint>& sources,
                                       const std::vector<PlaceInCover>& places, const std::vector<int>& component,
                                       const Progress& progress, DistanceReport& report) const {
  std::vector<std::uint8_t> is_first(sources.size());
  for (const int s : firstOfEach(sources)) is_first[s] = 1;
  std::vector<MarchStart> starts;
  for (const PlaceInCover& place : places)
    if (is_first[place.source] != 0) startAt(place, component, starts);
  const Workers workers(threads_, progress);
  MarchResult found =
      march(faces_, split_ > 0, starts, std::ldexp(maximum_, -faces_.exponent), workers, positionsOf(sources));
  report.split = split_;
  report.visits = found.visits;
  report.lowered = found.lowered;
  NearestSources result;
  result.distance.resize(vertices_);
  result.source.resize(number_.size());
  for (int i = 0; i < vertices_; ++i) {
    result.distance[i] = std::ldexp(found.distance[number_[i]], faces_.exponent);
    const bool is_reached = result.distance[i] < std::numeric_limits<double>::infinity();
    result.source[i] = !found.source.empty() ? found.source[number_[i]] : is_reached ? starts[0].source : -1;
  }
  return result;
}

}  // namespace tufted
