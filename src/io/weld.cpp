#include "io/weld.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <unordered_map>

#include "io/columns.h"

namespace tufted::io {
namespace {

using Position = std::array<double, 3>;

struct PositionHash {
  std::size_t operator()(const Position& position) const {
    std::uint64_t hash = 0;
    for (const double c : position) {
      // Adding zero makes -0 the same as 0, which compare equal.
      hash = (hash ^ std::bit_cast<std::uint64_t>(c + 0.0)) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 32;
    }
    return hash;
  }
};

}  // namespace

Welding findEqual(const Points& points) {
  Welding welding;
  welding.vertex.reserve(points.rows());
  std::unordered_map<Position, int, PositionHash> seen;
  seen.reserve(points.rows());
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const int next = static_cast<int>(welding.kept.size());
    // Vertices that are not finite stay apart (CGAL 5.5 merges a NaN with any other corner of an STL).
    if (points.row(i).allFinite()) {
      const auto [entry, inserted] = seen.try_emplace({points(i, 0), points(i, 1), points(i, 2)}, next);
      if (!inserted) {
        welding.vertex.push_back(entry->second);
        continue;
      }
    }
    welding.vertex.push_back(next);
    welding.kept.push_back(static_cast<int>(i));
  }
  return welding;
}

}  // namespace tufted::io

namespace tufted {
namespace {

Points keepRows(const Points& points, const std::vector<int>& kept) {
  Points rows(static_cast<Eigen::Index>(kept.size()), 3);
  for (std::size_t i = 0; i < kept.size(); ++i) rows.row(static_cast<Eigen::Index>(i)) = points.row(kept[i]);
  return rows;
}

}  // namespace

void weld(Geometry& geometry) {
  const io::Welding welding = io::findEqual(geometry.points);
  const std::size_t rows = welding.vertex.size();
  if (welding.kept.size() == rows) return;
  geometry.merged_vertices += static_cast<std::int64_t>(rows - welding.kept.size());
  geometry.points = keepRows(geometry.points, welding.kept);
  if (geometry.normals.rows() > 0) geometry.normals = keepRows(geometry.normals, welding.kept);
  for (Field& field : geometry.fields) {
    const std::size_t size = field.count * io::sizeOf(field.type);
    for (std::size_t i = 0; i < welding.kept.size(); ++i)  // kept[i] >= i, so nothing is overwritten too early
      std::memmove(field.bytes.data() + i * size, field.bytes.data() + welding.kept[i] * size, size);
    field.bytes.resize(welding.kept.size() * size);
  }
  for (int& corner : geometry.triangles.reshaped()) corner = welding.vertex[corner];
  geometry.width = static_cast<int>(welding.kept.size());
  geometry.height = 1;
}

}  // namespace tufted
