#include "algorithms/marching_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "algorithms/march.h"
#include "base/parallel.h"

namespace tufted {
namespace {

/// The distances of a point from the corners of a face may differ from those in the plane of the face by this part of
/// its longest side, by mollification; otherwise it is not the face of the source.
constexpr double same_face = 1e-3;

using Plane = std::array<Eigen::Vector2d, 3>;

/// The corners of a face in its plane.
Plane layOut(const MarchFace& face) {
  const auto& [a, b, c] = face.opposite;
  const double x = c > 0 ? (c + (b - a) * ((b + a) / c)) / 2 : 0, y = c > 0 ? face.double_area / c : b;
  return {Eigen::Vector2d(0, 0), Eigen::Vector2d(c, 0), Eigen::Vector2d(x, y)};
}

}  // namespace

MarchingDistance::MarchingDistance(const Laplacian& laplacian, const DistanceOptions& options)
    : vertices_(laplacian.cover().vertices),
      split_(options.split > 0),
      maximum_(options.maximum),
      threads_(options.solver.threads) {
  const Workers workers(threads_, options.solver.progress);
  faces_ = marchFaces(laplacian.cover(), options.split, workers);
  report_.method = "marching";
  report_.unknowns = std::int64_t{faces_.vertices} + (split_ ? faces_.edges : 0);
  report_.bytes = faces_.bytes();
}

/// The middles of the sides around a source inside a face are as far as they are in the plane of the face.
void MarchingDistance::startInFace(const SurfacePoint& source, int number, std::vector<MarchStart>& starts) const {
  const int first = source.corners[0];
  for (int s = faces_.corner_offset[first]; s < faces_.corner_offset[first + 1]; ++s) {
    const MarchFace& face = faces_.faces[faces_.corner_slots[s] / 3];
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
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector2d middle = (corner[(k + 1) % 3] + corner[(k + 2) % 3]) / 2;
      starts.push_back({faces_.vertices + face.edges[k], (place - middle).norm(), number});
    }
    return;
  }
}

void MarchingDistance::startAt(const SurfacePoint& source, int number, const std::vector<int>& component,
                               std::vector<MarchStart>& starts) const {
  bool all_active = true;
  for (int k = 0; k < 3; ++k) {
    all_active &= component[source.corners[k]] >= 0;
    if (component[source.corners[k]] >= 0)
      starts.push_back({source.corners[k], std::ldexp(source.distances[k], -faces_.exponent), number});
  }
  const auto& [a, b, c] = source.corners;
  // Faces that are split twice lie inside those of the cover.
  const bool has_faces = split_ && faces_.vertices == vertices_;
  if (has_faces && all_active && a != b && b != c && c != a) startInFace(source, number, starts);
}

NearestSources MarchingDistance::query(const std::vector<SurfacePoint>& sources, const std::vector<int>& component,
                                       const Progress& progress, DistanceReport& report) const {
  std::vector<MarchStart> starts;
  for (std::size_t s = 0; s < sources.size(); ++s) startAt(sources[s], static_cast<int>(s), component, starts);
  const Workers workers(threads_, progress);
  MarchResult found = march(faces_, split_, starts, std::ldexp(maximum_, -faces_.exponent), workers);
  report.visits = found.visits;
  report.lowered = found.lowered;
  NearestSources result;
  result.distance.resize(vertices_);
  for (int i = 0; i < vertices_; ++i) result.distance[i] = std::ldexp(found.distance[i], faces_.exponent);
  found.source.resize(static_cast<std::size_t>(vertices_));
  result.source = std::move(found.source);
  return result;
}

}  // namespace tufted
