#include "io/columns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <type_traits>

#include "io/errors.h"
#include "io/field_names.h"
#include "io/number.h"

namespace tufted::io {
namespace {

using Names = std::array<std::string_view, 3>;
using Places = std::array<std::size_t, 3>;

constexpr Names position = {"x", "y", "z"};
constexpr std::size_t longest_list = 200;  // an error lists names of fields up to about this many characters

/// Finds three fields with one value per point; nullopt if one is missing.
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

/// Whether columns 3, 4, 5 hold unit vectors (or zero, or NaN), not colours.
bool holdNormals(const Columns& columns) {
  bool any = false;
  for (std::size_t i = 0; i < static_cast<std::size_t>(columns.rows); ++i) {
    const auto value = [&](std::size_t c) { return tufted::valueOf(columns.fields[c], i); };
    const double length = std::hypot(value(3), value(4), value(5));
    if (length == 0 || std::isnan(length)) continue;
    if (std::abs(length - 1) > 0.02) return false;
    any = true;
  }
  return any;
}

/// Converts the fields at three places to double, and marks them as used.
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

char kindOf(FieldType type) {
  return visitType(type, []<class T>(T) { return !std::is_integral_v<T> ? 'f' : std::is_signed_v<T> ? 'i' : 'u'; });
}

std::optional<FieldType> typeOf(char kind, std::size_t size) {
  for (int number = 0; number <= static_cast<int>(FieldType::float64); ++number)
    if (const auto type = static_cast<FieldType>(number); kindOf(type) == kind && sizeOf(type) == size) return type;
  return std::nullopt;
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

void nameColumns(const std::filesystem::path& path, std::int64_t line, std::vector<Field>& fields) {
  nameFields(fields);
  if (find(fields, position)) return;
  std::string names;
  for (const Field& field : fields) {
    if (names.size() > longest_list) break;
    names += (names.empty() ? "; has " : ", ") + quote(field.name);
  }
  refuseLine(path, line, "has no fields x, y, z" + names);
}

void nameByPlace(Columns& columns, bool are_normals) {
  std::vector<std::string> names = {"x", "y", "z"};
  if (columns.fields.size() >= 6 && (are_normals || holdNormals(columns)))
    names.insert(names.end(), {"nx", "ny", "nz"});
  while (names.size() < columns.fields.size()) names.push_back("column" + std::to_string(names.size()));
  for (std::size_t c = 0; c < columns.fields.size(); ++c) columns.fields[c].name = names[c];
}

Geometry toGeometry(Columns&& columns) {
  std::vector<bool> used(columns.fields.size());
  Geometry geometry;
  geometry.points = take(columns, find(columns.fields, position).value(), used);
  if (const auto normal = find(columns.fields, {"nx", "ny", "nz"})) geometry.normals = take(columns, *normal, used);
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

bool tufted::isPackedColor(const Field& field) {
  return (field.name == "rgb" || field.name == "rgba") && field.count == 1 && io::sizeOf(field.type) == 4;
}
