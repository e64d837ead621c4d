#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tufted/io/read.h"

namespace tufted::io {

/// Calls `visit` with a zero of the C++ type that `type` stands for.
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

/// i for signed integers, u for unsigned ones, f for floats.
char kindOf(FieldType type);
inline bool isInteger(FieldType type) {
  return kindOf(type) != 'f';
}
/// The type of a kind, as kindOf() names it, and a size in bytes; nullopt if there is none.
std::optional<FieldType> typeOf(char kind, std::size_t size);
/// The value at `bytes`, in native byte order. 64-bit integers beyond 2^53 are rounded.
double valueOf(FieldType type, const std::byte* bytes);
/// Parses a token and stores it at `bytes`. Returns false if it is not a number of that type.
bool parseInto(std::string_view token, FieldType type, std::byte* bytes);

/// All values per point of a file, before positions and normals are separated from other fields.
struct Columns {
  std::vector<Field> fields;
  std::int64_t rows = 0;
};

/// Allocates the values of `rows` points in each field.
void allocate(Columns& columns, std::int64_t rows);

/// Applies nameFields() and checks that there are x, y and z. Called before values are read.
/// @param line the header's line with the names, for errors
/// @throws IoError if x, y or z is missing
void nameColumns(const std::filesystem::path& path, std::int64_t line, std::vector<Field>& fields);

/// Names columns of a file without names by their places: x, y, z, then nx, ny, nz if these are unit vectors, and
/// column3 or column6 and so on for the others.
/// @param are_normals whether columns 3 to 5 are normals whatever their length
void nameByPlace(Columns& columns, bool are_normals);

/// Moves x, y, z to `points`; nx, ny, nz, if all three are there, to `normals`; and all other fields except padding
/// (named "_") to `fields`. Width and height become those of an unorganized cloud.
/// @param columns named by nameColumns() or nameByPlace()
Geometry toGeometry(Columns&& columns);

/// Returns `rows` if it fits into int, the type of indices. @throws IoError if it does not
std::int64_t checkedRows(const std::filesystem::path& path, std::int64_t rows);

}  // namespace tufted::io
