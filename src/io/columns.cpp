#include "io/columns.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <optional>
#include <type_traits>

#include "io/errors.h"
#include "io/number.h"

namespace tufted::io {
namespace {

using Names = std::array<std::string_view, 3>;
using Places = std::array<std::size_t, 3>;

/// Index of the three fields, each with one value per point.
std::optional<Places> find(const std::vector<Field>& fields, const Names& names) {
  Places found = {};
  for (int c = 0; c < 3; ++c) {
    const auto field = std::find_if(fields.begin(), fields.end(), [&](const Field& candidate) {
      return candidate.name == names[c] && candidate.count == 1;
    });
    if (field == fields.end()) return std::nullopt;
    found[c] = static_cast<std::size_t>(field - fields.begin());
  }
  return found;
}

Places findPosition(const std::filesystem::path& path, std::int64_t line, const std::vector<Field>& fields) {
  const auto position = find(fields, {"x", "y", "z"});
  if (!position) refuseLine(path, line, "has no fields x, y, z");
  return *position;
}

/// Converts the three fields to double and marks them as used.
Points take(const Columns& columns, const Places& found, std::vector<bool>& used) {
  Points points(columns.rows, 3);
  for (int c = 0; c < 3; ++c) {
    const Field& field = columns.fields[found[c]];
    used[found[c]] = true;
    visitType(field.type, [&]<class T>(T) {
      for (std::int64_t i = 0; i < columns.rows; ++i) {
        T value;
        std::memcpy(&value, field.bytes.data() + i * sizeof(T), sizeof(T));
        points(i, c) = static_cast<double>(value);
      }
    });
  }
  return points;
}

}  // namespace

std::size_t sizeOf(FieldType type) {
  return visitType(type, [](auto zero) { return sizeof(zero); });
}

bool isInteger(FieldType type) {
  return visitType(type, [](auto zero) { return std::is_integral_v<decltype(zero)>; });
}

double valueOf(FieldType type, const std::byte* bytes) {
  return visitType(type, [bytes](auto value) {
    std::memcpy(&value, bytes, sizeof(value));
    return static_cast<double>(value);
  });
}

bool parseInto(std::string_view token, FieldType type, std::byte* bytes) {
  return visitType(type, [&](auto value) {
    if (!parseNumber(token, value)) return false;
    std::memcpy(bytes, &value, sizeof(value));
    return true;
  });
}

void allocate(Columns& columns, std::int64_t rows) {
  columns.rows = rows;
  for (Field& field : columns.fields) field.bytes.resize(rows * field.count * sizeOf(field.type));
}

void requirePosition(const std::filesystem::path& path, std::int64_t line, const std::vector<Field>& fields) {
  findPosition(path, line, fields);
}

Geometry toGeometry(const std::filesystem::path& path, std::int64_t line, Columns&& columns) {
  std::vector<bool> used(columns.fields.size());
  Geometry geometry;
  geometry.points = take(columns, findPosition(path, line, columns.fields), used);
  auto normal = find(columns.fields, {"normal_x", "normal_y", "normal_z"});
  if (!normal) normal = find(columns.fields, {"nx", "ny", "nz"});
  if (normal) geometry.normals = take(columns, *normal, used);
  for (std::size_t f = 0; f < columns.fields.size(); ++f) {
    if (!used[f] && columns.fields[f].name != "_") geometry.fields.push_back(std::move(columns.fields[f]));
  }
  geometry.width = static_cast<int>(columns.rows);
  return geometry;
}

std::int64_t checkedRows(const std::filesystem::path& path, std::int64_t rows) {
  if (rows > std::numeric_limits<int>::max()) refuse(path, std::to_string(rows) + " points are more than 2^31 - 1");
  return rows;
}

}  // namespace tufted::io

double tufted::valueOf(const Field& field, std::size_t i) {
  return io::valueOf(field.type, field.bytes.data() + i * io::sizeOf(field.type));
}
