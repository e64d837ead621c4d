#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "io/columns.h"

namespace tufted::io {

/// The header of a PCD file, versions 0.5 to 0.7.
struct PcdHeader {
  enum class Data { ascii, binary, binary_compressed };

  Columns columns;  ///< fields in the file's order, padding included, without values
  std::int64_t points = 0;
  std::int64_t width = 0;
  std::int64_t height = 1;
  std::array<double, 7> viewpoint = Geometry().viewpoint;
  Data data = Data::ascii;
  std::size_t body = 0;       ///< byte at which the values begin
  std::int64_t line = 0;      ///< number of lines of the header
  std::size_t row_bytes = 0;  ///< bytes per point
  std::int64_t row_values = 0;
};

/// Whether a field is padding, whose values are not kept.
inline bool isPadding(const Field& field) {
  return field.name == "_";
}

/// The format for people, as Geometry::format has it.
std::string formatName(const PcdHeader& header);

/// Allocates the values of all fields except padding, which may be far larger than the file.
void allocate(PcdHeader& header);

/// Parses a header, and checks that counts and sizes are in range and points = width x height.
/// @param text at least the header
/// @throws IoError naming the line
PcdHeader parsePcdHeader(const std::filesystem::path& path, std::string_view text);

}  // namespace tufted::io
