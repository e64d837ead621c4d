#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "tufted/io/read.h"

namespace tufted::io {

/// Calls `visit` with a zero of the type that `type` names.
template <class Visitor>
decltype(auto) visitType(FieldType type, Visitor&& visit) {
  switch (type) {
    // NOLINTNEXTLINE(bugprone-branch-clone): each calls another visit()
    case FieldType::int8:
      return visit(std::int8_t());
    case FieldType::uint8:
      return visit(std::uint8_t());
    case FieldType::int16:
      return visit(std::int16_t());
    case FieldType::uint16:
      return visit(std::uint16_t());
    case FieldType::int32:
      return visit(std::int32_t());
    case FieldType::uint32:
      return visit(std::uint32_t());
    case FieldType::int64:
      return visit(std::int64_t());
    case FieldType::uint64:
      return visit(std::uint64_t());
    case FieldType::float32:
      return visit(float());
    case FieldType::float64:
      break;
  }
  return visit(double());
}

std::size_t sizeOf(FieldType type);
bool isInteger(FieldType type);
/// The value at `bytes`, in native byte order. 64-bit integers beyond 2^53 are rounded.
double valueOf(FieldType type, const std::byte* bytes);
/// Parses a token and stores it at `bytes`. False if it is not a number of that type.
bool parseInto(std::string_view token, FieldType type, std::byte* bytes);

/// The values of a file per point, before x, y, z and the normals are separated from other fields.
struct Columns {
  std::vector<Field> fields;
  std::int64_t rows = 0;
};

/// Makes room for `rows` values in each field.
void allocate(Columns& columns, std::int64_t rows);

/// Gives the fields the names that are known and checks that x, y, z are among them, before their values are read.
/// @param line line of the header that names the fields
/// @throws IoError without x, y, z
void nameColumns(const std::filesystem::path& path, std::int64_t line, std::vector<Field>& fields);

/// Names columns without names by their places: x y z, normals if the next three are unit vectors, column6, column7,
/// ...
/// @param are_normals whether the next three are normals of any length
void nameByPlace(Columns& columns, bool are_normals);

/// Moves x, y, z to `points`, a full set of nx, ny, nz to `normals`, and all other fields to `fields`, except padding
/// (named "_"). Width and height are those of an unorganized cloud.
/// @param columns with the names that nameColumns() or nameByPlace() gave
Geometry toGeometry(Columns&& columns);

/// Checks that a number of rows fits into int, which numbers the points. @throws IoError if it does not
std::int64_t checkedRows(const std::filesystem::path& path, std::int64_t rows);

}  // namespace tufted::io
