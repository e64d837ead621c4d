// Points within a radius of sources, by marching over the faces near the sources only.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "algorithms/connected.h"
#include "algorithms/march.h"
#include "algorithms/march_faces.h"
#include "base/cover_source.h"
#include "base/number_text.h"
#include "base/sort_unique.h"
#include "cover/face_scale.h"
#include "cover/geometry.h"
#include "operators/check_cover.h"
#include "operators/distinct_faces.h"
#include "tufted/check.h"
#include "tufted/components.h"
#include "tufted/distance.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

constexpr const char* function = "pointsWithin";
/// Faces are collected up to this many longest edges of the source beyond the radius, as flips span one or two.
/// isComplete() finds out if faces are missing; with 6 a query takes 1.5 times as long.
constexpr double margin_in_spacings = 3;
/// Tries, each with twice the margin of the one before: in a depth image points lie farther apart behind the source.
/// Then the whole cover is built.
constexpr int most_tries = 3;
/// The areas around a point by the collected faces and by the whole cover are equal up to this part, as sums run in
/// different orders.
constexpr double same_area = 1e-9;

int checkedSource(const Laplacian& laplacian, int source) {
  const auto n = std::ssize(laplacian.status);
  if (source < 0 || source >= n) {
    throw InvalidInput(std::string(function) + ": source " + std::to_string(source) + ", must lie in [0, " +
                       std::to_string(n) + ")");
  }
  return laplacian.representative[source];
}

/// The representatives of active sources, ascending, each once.
std::vector<int> checkedSources(const Laplacian& laplacian, const std::vector<int>& sources, double radius) {
  const std::string name = std::string(function) + ": ";
  const auto n = std::ssize(laplacian.status);
  if (!laplacian.hasCover()) throw InvalidInput(name + "the Laplacian has no cover, must have one");
  if (laplacian.positions.rows() != n || std::ssize(laplacian.representative) != n)
    throw InvalidInput(name + "positions has " + std::to_string(laplacian.positions.rows()) + " rows, must have " +
                       std::to_string(n));
  if (!laplacian.component.empty() && std::ssize(laplacian.component) != n)
    throw InvalidInput(name + "component has " + std::to_string(laplacian.component.size()) + " values, must have " +
                       std::to_string(n));
  if (!(radius > 0 && std::isfinite(radius)))
    throw InvalidInput(name + "radius = " + numberText(radius) + ", must be finite and above 0");
  if (sources.empty()) throw InvalidInput(name + "sources is empty, must name at least one");
  std::vector<int> found;
  for (const int source : sources) {
    const int point = checkedSource(laplacian, source);
    if (laplacian.status[point] == PointStatus::active) found.push_back(point);
  }
  if (found.empty()) {
    throw InvalidInput(name + "no source lies on a component, must be at least one active point: " +
                       whyOnNone("source", sources[0], laplacian.status[laplacian.representative[sources[0]]]));
  }
  sortUnique(found);
  return found;
}

struct Faces {
  std::vector<std::array<int, 3>> corners;
  std::vector<double> length;  ///< of the side from each corner to the next
};

/// The longest distance of a point from a neighbour in L.
double spacingAt(const Laplacian& laplacian, int point) {
  double longest = 0;
  for (SparseMatrix::InnerIterator entry(laplacian.L, point); entry; ++entry)
    longest = std::max(longest, (laplacian.positions.row(entry.row()) - laplacian.positions.row(point)).norm());
  return longest;
}

/// Collects faces from the stars of points near the sources. Some may be missing, see isComplete(). False if there are
/// no stars.
/// @param margin how far beyond the radius stars are collected
bool facesFromStars(const Laplacian& laplacian, const std::vector<int>& sources, double radius, double margin,
                    Faces& faces) {
  if (!laplacian.hasCover() || laplacian.cover_areas.size() == 0) return false;
  std::vector<Ball> balls;
  balls.reserve(sources.size());
  for (const int source : sources) balls.push_back({laplacian.positions.row(source), radius + margin});
  return laplacian.cover_source->appendFacesNear(balls, faces.corners, faces.length);
}

/// All faces with a corner in a ball of the radius around a source; no path is shorter than the straight line.
Faces facesFromCover(const Laplacian& laplacian, const std::vector<int>& sources, double radius) {
  checkCover(function, laplacian);
  const IntrinsicTriangulation& cover = laplacian.cover();
  std::vector<std::uint8_t> is_near(static_cast<std::size_t>(cover.vertices), 0);
  for (const int source : sources) {
    const Eigen::RowVector3d center = laplacian.positions.row(source);
    for (Eigen::Index i = 0; i < laplacian.positions.rows(); ++i)
      if ((laplacian.positions.row(i) - center).stableNorm() <= radius) is_near[i] = 1;
  }
  Faces faces;
  for (std::int64_t f = 0; f < cover.size(); ++f) {
    const auto& [a, b, c] = cover.faces[f];
    if (is_near[a] + is_near[b] + is_near[c] == 0) continue;
    faces.corners.push_back(cover.faces[f]);
    faces.length.insert(faces.length.end(), cover.length.begin() + 3 * f, cover.length.begin() + 3 * f + 3);
  }
  return faces;
}

/// Distinct faces whose corners are numbered from 0 in the order of the points.
struct Patch {
  std::vector<int> points;                 ///< ascending
  std::unordered_map<int, int> number_of;  ///< number of each point
  std::vector<DistinctFace> faces;
  int exponent = 0;
};

Patch patchOf(Faces faces, const Workers& workers) {
  Patch patch;
  patch.number_of.reserve(faces.corners.size() / 4);
  for (const auto& corners : faces.corners)
    for (const int corner : corners)
      if (patch.number_of.try_emplace(corner, 0).second) patch.points.push_back(corner);
  std::sort(patch.points.begin(), patch.points.end());
  for (std::size_t i = 0; i < patch.points.size(); ++i) patch.number_of[patch.points[i]] = static_cast<int>(i);
  const auto vertices = static_cast<int>(patch.points.size());
  for (auto& face : faces.corners)
    for (int& corner : face) corner = patch.number_of.find(corner)->second;
  StoredCover local({vertices, std::move(faces.corners), {}, std::move(faces.length)});
  patch.faces = distinctFaces(local, vertices, workers);
  patch.exponent = unitOf(patch.faces);
  return patch;
}

std::vector<double> distancesOn(const Laplacian& laplacian, const Patch& patch, const std::vector<int>& sources,
                                double radius, int split, const Workers& workers) {
  const MarchFaces faces = marchFaces(patch.faces, static_cast<int>(patch.points.size()), patch.exponent, split,
                                      workers, laplacian.positions(patch.points, Eigen::all));
  std::vector<MarchStart> starts;
  SourcePositions positions;
  for (const int source : sources) {
    const auto at = patch.number_of.find(source);
    if (at == patch.number_of.end()) continue;
    starts.push_back({at->second, 0, static_cast<int>(positions.size())});
    positions.push_back(faces.positions[at->second]);
  }
  std::vector<double> distance =
      march(faces, split > 0, starts, std::ldexp(radius, -faces.exponent), workers, positions).distance;
  distance.resize(patch.points.size());
  for (double& d : distance) d = std::ldexp(d, faces.exponent);
  return distance;
}

/// Whether all faces at points within the radius were collected: the areas around these are those of the whole cover.
bool isComplete(const Laplacian& laplacian, const Patch& patch, const std::vector<double>& distance, double radius) {
  std::vector<double> area(patch.points.size(), 0);
  for (const DistinctFace& face : patch.faces) {
    const auto& [a, b, c] = face.opposite;
    const double share = face.copies * faceScale(laplacian.kind) * triangleArea(a, b, c) / 3;
    for (const int corner : face.corners) area[corner] += share;
  }
  for (std::size_t i = 0; i < area.size(); ++i) {
    if (!(distance[i] <= radius)) continue;
    const double whole = laplacian.cover_areas[patch.points[i]];
    if (!(std::abs(area[i] - whole) <= same_area * whole)) return false;
  }
  return true;
}

/// Makes distances infinite on components without a source. Stored labels save a pass over L.
void leaveOtherComponents(const Laplacian& laplacian, const std::vector<int>& sources, const Patch& patch,
                          std::vector<double>& distance) {
  const std::vector<int> made = laplacian.component.empty() ? componentLabels(laplacian) : std::vector<int>();
  const std::vector<int>& label = laplacian.component.empty() ? made : laplacian.component;
  std::vector<int> kept;
  kept.reserve(sources.size());
  for (const int source : sources) kept.push_back(label[source]);
  std::sort(kept.begin(), kept.end());
  for (std::size_t i = 0; i < distance.size(); ++i)
    if (!std::binary_search(kept.begin(), kept.end(), label[patch.points[i]])) distance[i] = HUGE_VAL;
}

}  // namespace

NearbyPoints pointsWithin(const Laplacian& laplacian, const std::vector<int>& sources, double radius,
                          std::optional<int> split, const Progress& progress) {
  const std::vector<int> known = checkedSources(laplacian, sources, radius);
  const int times = checkedSplit(function, split, laplacian);
  const Workers workers(1, progress);
  workers.report("march", 0);
  Patch patch;
  std::vector<double> distance;
  double spacing = 0;
  for (const int source : known) spacing = std::max(spacing, spacingAt(laplacian, source));
  bool is_complete = false;
  for (int tries = 0; tries < most_tries && !is_complete; ++tries, spacing *= 2) {
    Faces faces;
    if (!facesFromStars(laplacian, known, radius, margin_in_spacings * spacing, faces)) break;
    patch = patchOf(std::move(faces), workers);
    distance = distancesOn(laplacian, patch, known, radius, times, workers);
    is_complete =
        std::all_of(known.begin(), known.end(), [&](int source) { return patch.number_of.count(source) > 0; }) &&
        isComplete(laplacian, patch, distance, radius);
  }
  if (!is_complete) {
    patch = patchOf(facesFromCover(laplacian, known, radius), workers);
    distance = distancesOn(laplacian, patch, known, radius, times, workers);
  }
  leaveOtherComponents(laplacian, known, patch, distance);
  std::vector<std::pair<int, double>> found;
  for (std::size_t i = 0; i < distance.size(); ++i)
    if (distance[i] <= radius) found.emplace_back(patch.points[i], distance[i]);
  const bool has_copies =
      std::find(laplacian.status.begin(), laplacian.status.end(), PointStatus::coincident) != laplacian.status.end();
  if (has_copies) {
    for (int i = 0; i < std::ssize(laplacian.representative); ++i) {
      const auto at = patch.number_of.find(laplacian.representative[i]);
      if (at == patch.number_of.end() || at->first == i || !(distance[at->second] <= radius)) continue;
      found.emplace_back(i, distance[at->second]);
    }
    std::sort(found.begin(), found.end());
  }
  NearbyPoints result;
  for (const auto& [point, d] : found) {
    result.points.push_back(point);
    result.distances.push_back(d);
  }
  return result;
}

}  // namespace tufted
