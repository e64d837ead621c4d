#include "io/weld.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace tufted::io {
namespace {

using Position = std::array<double, 3>;

struct PositionHash {
  std::size_t operator()(const Position& position) const {
    std::uint64_t hash = 0;
    for (const double c : position) {
      // Adding zero turns -0 into 0, so that equal numbers have equal hashes.
      hash = (hash ^ std::bit_cast<std::uint64_t>(c + 0.0)) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 32;
    }
    return hash;
  }
};

}  // namespace

void weld(Geometry& geometry) {
  Points& points = geometry.points;
  std::vector<int> vertex(static_cast<std::size_t>(points.rows()));
  std::unordered_map<Position, int, PositionHash> seen;
  seen.reserve(vertex.size());
  int kept = 0;
  for (std::size_t i = 0; i < vertex.size(); ++i) {
    const Position position = {points(i, 0), points(i, 1), points(i, 2)};
    vertex[i] = kept;
    // Corners that are not finite are never merged.
    if (points.row(i).allFinite()) {
      const auto [entry, inserted] = seen.try_emplace(position, kept);
      vertex[i] = entry->second;
      if (!inserted) continue;
    }
    points.row(kept++) = points.row(i);  // kept <= i, so nothing is overwritten too early
  }
  geometry.merged_vertices = points.rows() - kept;
  points.conservativeResize(kept, 3);
  for (int& corner : geometry.triangles.reshaped()) corner = vertex[corner];
  geometry.width = kept;
}

}  // namespace tufted::io
