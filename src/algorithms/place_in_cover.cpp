// Locates points inside triangles of a mesh in its cover after flips. Flips keep the surface: a removed triangle is
// still a flat part of it without a vertex inside. Along straight lines from one corner, the other two corners are
// found at the lengths of its sides and with its angle between them; this determines the place of the point.
#include "algorithms/place_in_cover.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <unordered_map>

#include "algorithms/vertex_view.h"
#include "base/number_text.h"
#include "cover/geometry.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

/// A vertex counts as on a line if it is no farther from it than this part of the longer side. The values are tried in
/// turn: the first allows for rounding, the others for mollification.
constexpr std::array<double, 3> line_tolerances = {1e-9, 1e-6, 1e-3};
/// If a match is exact up to this part of the longer side, the search ends.
constexpr double exact_fit = 1e-9;
/// Weights of a source sum to 1 up to this.
constexpr double rounding_of_weights = 1e-6;

void checkGlue(const std::string& function, const IntrinsicTriangulation& cover) {
  const auto sides = std::ssize(cover.glue);
  bool is_glued = sides == 3 * cover.size();
  for (std::int64_t side = 0; is_glued && side < sides; ++side) {
    const int mate = cover.glue[side];
    is_glued = mate >= 0 && mate < sides && cover.glue[mate] == side;
  }
  if (!is_glued) throw InvalidInput(function + ": cover is not glued, must be for a source inside a triangle");
}

int nearestCorner(const SurfacePoint& source) {
  const auto& d = source.distances;
  return source.corners[std::min_element(d.begin(), d.end()) - d.begin()];
}

bool isAtVertex(const SurfacePoint& source) {
  const auto& [a, b, c] = source.corners;
  return (a == b && b == c) || *std::min_element(source.distances.begin(), source.distances.end()) == 0;
}

/// The sides of a cover that start at the nearest corners of sources inside triangles.
std::unordered_map<int, std::vector<int>> sidesAt(const IntrinsicTriangulation& cover,
                                                  const std::vector<SurfacePoint>& sources) {
  std::unordered_map<int, std::vector<int>> sides;
  for (const SurfacePoint& source : sources)
    if (!isAtVertex(source)) sides[nearestCorner(source)];
  for (int side = 0; !sides.empty() && side < std::ssize(cover.glue); ++side) {
    const auto found = sides.find(tail(cover, side));
    if (found != sides.end()) found->second.push_back(side);
  }
  return sides;
}

/// The places of a point on the front and on the back of its triangle. If the triangle is there several times, any one
/// of the places.
std::vector<PlaceInCover> placesOf(const IntrinsicTriangulation& cover, const Wedge& wedge,
                                   const std::vector<int>& sides) {
  std::vector<VertexView> views;
  std::vector<int> left = sides;
  while (!left.empty()) {
    views.emplace_back(cover, wedge, left.front());
    std::vector<int> used;
    views.back().forSides([&](int side) { used.push_back(side); });
    std::sort(used.begin(), used.end());
    std::erase_if(left, [&](int side) { return std::binary_search(used.begin(), used.end(), side); });
  }
  std::array<VertexView::Match, 2> best;
  std::array<const VertexView*, 2> where = {};
  const auto lookAtAll = [&] {
    for (const VertexView& view : views) {
      for (int k = 0; k < 2; ++k) {
        const VertexView::Match match = view.match(1 - 2 * k);
        if (match.misfit < best[k].misfit) best[k] = match, where[k] = &view;
      }
    }
  };
  lookAtAll();
  if (!(std::max(best[0].misfit, best[1].misfit) <= exact_fit)) {
    for (VertexView& view : views) view.lookFarther();
    lookAtAll();
  }
  std::vector<PlaceInCover> places;
  for (int k = 0; k < 2; ++k) {
    if (!(best[k].misfit <= Wedge::same_triangle * wedge.length[0])) continue;
    const PlaceInCover place = where[k]->follow(best[k]);
    if (place.face >= 0) places.push_back(place);
  }
  return places;
}

}  // namespace

void checkPlace(const std::string& function, const SurfacePoint& source, int n) {
  const std::string name = function + ": ";
  for (int k = 0; k < 3; ++k) {
    if (source.corners[k] < 0 || source.corners[k] >= n) {
      throw InvalidInput(name + "source " + std::to_string(source.corners[k]) + ", must lie in [0, " +
                         std::to_string(n) + ")");
    }
    if (!(source.weights[k] >= 0 && source.weights[k] <= 1)) {
      throw InvalidInput(name + "weight of a source = " + numberText(source.weights[k]) + ", must lie in [0, 1]");
    }
    if (!(source.distances[k] >= 0 && std::isfinite(source.distances[k]))) {
      throw InvalidInput(name + "distance of a source from a corner = " + numberText(source.distances[k]) +
                         ", must be finite and at least 0");
    }
    if (!(source.sides[k] >= 0 && std::isfinite(source.sides[k]))) {
      throw InvalidInput(name + "side of a source's triangle = " + numberText(source.sides[k]) +
                         ", must be finite and at least 0");
    }
  }
  const double sum = source.weights[0] + source.weights[1] + source.weights[2];
  if (!(std::abs(sum - 1) < rounding_of_weights))
    throw InvalidInput(name + "weights of a source sum to " + numberText(sum) + ", must sum to 1");
}

std::vector<PlaceInCover> placesInCover(const std::string& function, const CoverSource& source_of_cover,
                                        const std::vector<SurfacePoint>& sources) {
  const IntrinsicTriangulation none;
  const bool are_vertices = std::all_of(sources.begin(), sources.end(), isAtVertex);
  const IntrinsicTriangulation& cover = are_vertices ? none : source_of_cover.cover();
  if (!are_vertices) checkGlue(function, cover);
  const auto sides = sidesAt(cover, sources);
  std::vector<PlaceInCover> places;
  for (int s = 0; s < std::ssize(sources); ++s) {
    const int corner = nearestCorner(sources[s]);
    if (isAtVertex(sources[s])) {
      places.push_back({s, -1, SurfacePoint::vertex(corner)});
      places.back().point.distances.fill(*std::min_element(sources[s].distances.begin(), sources[s].distances.end()));
      continue;
    }
    const auto& [a, b, c] = sources[s].corners;
    std::vector<PlaceInCover> found;
    for (const double part : line_tolerances)
      if (found.empty() && a != b && b != c && c != a)
        found = placesOf(cover, Wedge::of(sources[s], part), sides.find(corner)->second);
    if (found.empty())
      throw InvalidInput(function + ": source in the triangle " + std::to_string(a) + " " + std::to_string(b) + " " +
                         std::to_string(c) + ", must lie in a triangle of the surface");
    for (PlaceInCover& place : found) {
      place.source = s;
      places.push_back(place);
    }
  }
  return places;
}

}  // namespace tufted
