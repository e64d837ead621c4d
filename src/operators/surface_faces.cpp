// Gradients and divergences on faces for the heat method (Crane, Weischedel, Wardetzky 2013, 2017).
#include "operators/surface_faces.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "cover/geometry.h"

namespace tufted {
namespace {

constexpr std::int64_t block_size = 8192;

/// A face whose side `k` lies opposite corner `k`, sorted: equal faces compare equal whichever way they run.
struct Key {
  std::array<int, 3> corners;
  std::array<double, 3> opposite;

  bool operator<(const Key& other) const {
    return std::tie(corners, opposite) < std::tie(other.corners, other.opposite);
  }
  bool operator==(const Key& other) const { return corners == other.corners && opposite == other.opposite; }
};

Key keyOf(const IntrinsicTriangulation& cover, std::int64_t face) {
  std::array<std::pair<int, double>, 3> parts;
  for (int s = 0; s < 3; ++s) parts[s] = {cover.faces[face][s], cover.length[3 * face + (s + 1) % 3]};
  std::sort(parts.begin(), parts.end());
  return {{parts[0].first, parts[1].first, parts[2].first}, {parts[0].second, parts[1].second, parts[2].second}};
}

/// The numbers of the faces, grouped by their smallest corner.
std::vector<int> facesByCorner(const IntrinsicTriangulation& cover, std::vector<int>& offset) {
  const auto owner = [&](std::int64_t face) {
    return *std::min_element(cover.faces[face].begin(), cover.faces[face].end());
  };
  offset.assign(static_cast<std::size_t>(cover.vertices) + 1, 0);
  for (std::int64_t f = 0; f < cover.size(); ++f) ++offset[owner(f) + 1];
  std::partial_sum(offset.begin(), offset.end(), offset.begin());
  std::vector<int> list(cover.faces.size()), fill(offset.begin(), offset.end() - 1);
  for (std::int64_t f = 0; f < cover.size(); ++f) list[fill[owner(f)]++] = static_cast<int>(f);
  return list;
}

/// @returns whether the face has an area
bool layOut(const Key& key, double weight, int exponent, SurfaceFace& face) {
  std::array<double, 3> opposite;
  for (int k = 0; k < 3; ++k) opposite[k] = std::ldexp(key.opposite[k], -exponent);
  const int top = static_cast<int>(std::max_element(opposite.begin(), opposite.end()) - opposite.begin());
  const int first = (top + 1) % 3, second = (top + 2) % 3;
  const double base = opposite[top], from_first = opposite[second], from_second = opposite[first];
  const double area = triangleArea(base, from_first, from_second);
  if (!(area > 0) || !std::isfinite(area)) return false;
  face.corners = {key.corners[first], key.corners[second], key.corners[top]};
  face.base = base;
  face.foot = (base + (from_first - from_second) * ((from_first + from_second) / base)) / 2;
  face.height = 2 * area / base;
  face.weight = weight;
  return face.height > 0;
}

double squaredSides(const SurfaceFace& face) {
  const double rest = face.base - face.foot;
  return face.base * face.base + face.foot * face.foot + rest * rest + 2 * face.height * face.height;
}

int unitOf(const std::vector<double>& lengths) {
  double largest = 0;
  for (const double length : lengths) largest = std::max(largest, length);
  if (!(largest > 0) || !std::isfinite(largest)) return 0;
  double sum = 0;
  for (const double length : lengths) sum += length / largest;
  return std::ilogb(largest) + std::ilogb(sum / static_cast<double>(lengths.size()));
}

}  // namespace

SurfaceFaces distinctFaces(const IntrinsicTriangulation& cover, double scale, const Workers& workers) {
  SurfaceFaces surface;
  surface.exponent = unitOf(cover.length);
  std::vector<int> offset;
  const std::vector<int> list = facesByCorner(cover, offset);
  std::vector<std::vector<SurfaceFace>> parts((cover.vertices + block_size - 1) / block_size);
  workers.forBlocks("faces", cover.vertices, block_size, [&](std::int64_t begin, std::int64_t end, int) {
    std::vector<Key> keys;
    for (auto v = begin; v < end; ++v) {
      keys.clear();
      for (int i = offset[v]; i < offset[v + 1]; ++i) keys.push_back(keyOf(cover, list[i]));
      std::sort(keys.begin(), keys.end());
      for (auto key = keys.begin(); key != keys.end();) {
        const auto next = std::find_if(key, keys.end(), [&](const Key& other) { return !(other == *key); });
        SurfaceFace face;
        if (layOut(*key, scale * static_cast<double>(next - key), surface.exponent, face)) {
          parts[begin / block_size].push_back(face);
        }
        key = next;
      }
    }
  });
  for (auto& part : parts) {
    surface.faces.insert(surface.faces.end(), part.begin(), part.end());
    part = {};
  }
  double weight = 0, squares = 0, area = 0, area_squares = 0;
  for (const SurfaceFace& face : surface.faces) {
    const double square = squaredSides(face) / 3, here = face.weight * face.base * face.height;
    weight += face.weight, squares += face.weight * square;
    area += here, area_squares += here * square;
  }
  if (weight > 0) surface.mean_square = squares / weight, surface.area_mean_square = area_squares / area;
  return surface;
}

VectorXd lumpedAreas(const SurfaceFaces& surface, int size) {
  VectorXd areas = VectorXd::Zero(size);
  for (const SurfaceFace& face : surface.faces) {
    for (const int corner : face.corners) areas[corner] += face.weight * face.base * face.height / 6;
  }
  return areas;
}

}  // namespace tufted
