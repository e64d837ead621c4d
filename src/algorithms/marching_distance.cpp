#include "algorithms/marching_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "algorithms/apex.h"
#include "algorithms/march.h"
#include "base/parallel.h"
#include "base/stage_clock.h"

namespace tufted {
namespace {

/// The distances of a point from the corners of a face may differ from those in the plane of the face by this part of
/// its longest side, by mollification; otherwise it is not the face of the source.
constexpr double same_face = 1e-3;

using Plane = std::array<Eigen::Vector2d, 3>;

/// The corners of a face in its plane.
Plane layOut(const MarchFace& face) {
  const auto& [a, b, c] = face.opposite;
  const Eigen::Vector2d first(0, 0), second(c, 0);
  return {first, second, apexLeftOf(first, second, b, a, face.double_area)};
}

bool hasCorner(const MarchFace& face, int vertex) {
  return std::find(face.corners.begin(), face.corners.end(), vertex) != face.corners.end();
}

}  // namespace

/// A face of the cover that is cut once or twice.
struct MarchingDistance::CoverFace {
  MarchFace face;                    ///< without its edges
  std::array<int, 3> middle;         ///< the vertex in the middle of each side
  std::span<const MarchFace> parts;  ///< what is stored of it
};

MarchingDistance::MarchingDistance(const Laplacian& laplacian, int split, const DistanceOptions& options)
    : number_(numbersByFaces(laplacian.cover())),
      vertices_(laplacian.cover().vertices),
      split_(split),
      maximum_(options.maximum),
      threads_(options.solver.threads) {
  const Workers workers(threads_, options.solver.progress);
  faces_ = marchFaces(laplacian.cover(), split_, workers, number_);
  report_.method = "marching";
  report_.unknowns = std::int64_t{faces_.vertices} + (split_ > 0 ? faces_.edges : 0);
  report_.bytes = faces_.bytes() + bytesOf(number_);
}

/// @param face a stored one
MarchingDistance::CoverFace MarchingDistance::coverFace(int face) const {
  const MarchFace& stored = faces_.faces[face];
  CoverFace result = {stored, {}, {&stored, 1}};
  if (split_ == 1) {
    for (int k = 0; k < 3; ++k) result.middle[k] = vertices_ + stored.edges[k];
    return result;
  }
  // Four parts in a row: one at each corner, and one between the middles of the sides.
  const MarchFace* const part = &faces_.faces[face / 4 * 4];
  result.parts = {part, 4};
  result.face.double_area = 4 * part[3].double_area;
  for (int k = 0; k < 3; ++k) {
    const auto& corners = part[k].corners;
    result.face.corners[k] = *std::min_element(corners.begin(), corners.end());  // points come before middles
    for (int i = 0; i < 3; ++i) {
      if (hasCorner(part[k], part[3].corners[i])) continue;
      result.middle[k] = part[3].corners[i];
      result.face.opposite[k] = 2 * part[3].opposite[i];
    }
  }
  return result;
}

/// All vertices in and around the face that a source lies in are as far as they are in the plane of the face.
/// @param source with corners numbered as in `faces_`
void MarchingDistance::startInFace(const SurfacePoint& source, int number, std::vector<MarchStart>& starts) const {
  const int first = source.corners[0];
  for (int s = faces_.corner_offset[first]; s < faces_.corner_offset[first + 1]; ++s) {
    const CoverFace whole = coverFace(faces_.corner_slots[s] / 3);
    const MarchFace& face = whole.face;
    if (face.corners[0] == face.corners[1] || face.corners[1] == face.corners[2] || face.corners[2] == face.corners[0])
      continue;  // after flips; the source lies in another face of its corners
    const Plane corner = layOut(face);
    Eigen::Vector2d place = Eigen::Vector2d::Zero();
    std::array<int, 3> number_of{};  // corner of the source, by corner of the face
    bool is_same = true;
    for (int k = 0; k < 3; ++k) {
      const auto found = std::find(source.corners.begin(), source.corners.end(), face.corners[k]);
      is_same &= found != source.corners.end();
      if (!is_same) break;
      number_of[k] = static_cast<int>(found - source.corners.begin());
      place += source.weights[number_of[k]] * corner[k];
    }
    const double longest = *std::max_element(face.opposite.begin(), face.opposite.end());
    for (int k = 0; is_same && k < 3; ++k) {
      const double given = std::ldexp(source.distances[number_of[k]], -faces_.exponent);
      is_same = std::abs((place - corner[k]).norm() - given) <= same_face * longest;
    }
    if (!is_same) continue;
    const auto middle = [](const Plane& plane, int k) -> Eigen::Vector2d {
      return (plane[(k + 1) % 3] + plane[(k + 2) % 3]) / 2;
    };
    for (int k = 0; k < 3; ++k) starts.push_back({whole.middle[k], (place - middle(corner, k)).norm(), number});
    const auto at = [&](int vertex) -> Eigen::Vector2d {
      const auto found = std::find(face.corners.begin(), face.corners.end(), vertex);
      if (found != face.corners.end()) return corner[found - face.corners.begin()];
      return middle(
          corner, static_cast<int>(std::find(whole.middle.begin(), whole.middle.end(), vertex) - whole.middle.begin()));
    };
    for (const MarchFace& part : whole.parts) {
      const Plane plane = {at(part.corners[0]), at(part.corners[1]), at(part.corners[2])};
      for (int i = 0; i < 3; ++i)
        starts.push_back({faces_.vertices + part.edges[i], (place - middle(plane, i)).norm(), number});
    }
    return;
  }
}

void MarchingDistance::startAt(const SurfacePoint& source, int number, const std::vector<int>& component,
                               std::vector<MarchStart>& starts) const {
  SurfacePoint place = source;
  bool all_active = true;
  for (int k = 0; k < 3; ++k) {
    place.corners[k] = number_[source.corners[k]];
    all_active &= component[source.corners[k]] >= 0;
    if (component[source.corners[k]] >= 0)
      starts.push_back({place.corners[k], std::ldexp(source.distances[k], -faces_.exponent), number});
  }
  const auto& [a, b, c] = place.corners;
  if (split_ > 0 && all_active && a != b && b != c && c != a) startInFace(place, number, starts);
}

NearestSources MarchingDistance::query(const std::vector<SurfacePoint>& sources, const std::vector<int>& component,
                                       const Progress& progress, DistanceReport& report) const {
  std::vector<MarchStart> starts;
  for (std::size_t s = 0; s < sources.size(); ++s) startAt(sources[s], static_cast<int>(s), component, starts);
  const Workers workers(threads_, progress);
  MarchResult found = march(faces_, split_ > 0, starts, std::ldexp(maximum_, -faces_.exponent), workers);
  report.split = split_;
  report.visits = found.visits;
  report.lowered = found.lowered;
  NearestSources result;
  result.distance.resize(vertices_);
  result.source.resize(number_.size());
  for (int i = 0; i < vertices_; ++i) {
    result.distance[i] = std::ldexp(found.distance[number_[i]], faces_.exponent);
    result.source[i] = found.source[number_[i]];
  }
  return result;
}

}  // namespace tufted
