#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/columns.h"

namespace tufted::io {

struct PlyProperty {
  std::string name;
  FieldType type = FieldType::float32;  ///< type of the value, or of the values of a list
  bool is_list = false;
  FieldType count_type = FieldType::uint8;  ///< type of the number before a list's values
};

struct PlyElement {
  std::string name;
  std::int64_t count = 0;
  std::vector<PlyProperty> properties;
};

/// The header of a PLY file.
struct PlyHeader {
  enum class Format { ascii, little_endian, big_endian };

  Format format = Format::ascii;
  std::vector<PlyElement> elements;
  std::int64_t columns = 0, rows = 0;                      ///< obj_info num_cols, num_rows of an organized cloud
  std::array<double, 7> viewpoint = Geometry().viewpoint;  ///< obj_info viewpoint, as writePly() writes it
  std::size_t body = 0;                                    ///< byte at which the values begin
  std::int64_t line = 0;                                   ///< number of lines of the header
};

/// The columns of the vertices, without values. Lists have none.
/// @throws IoError naming the line `header_lines` if x, y or z is missing
Columns columnsOf(const std::filesystem::path& path, std::int64_t header_lines, const PlyElement& vertices);

/// The name of a type in a header; that of double for 64-bit integers, which PLY does not have.
const char* plyType(FieldType type);

/// The format for people, as Geometry::format has it.
std::string formatName(const PlyHeader& header);

/// Sets width and height of an organized cloud of `points` points.
void organize(const PlyHeader& header, std::int64_t points, Geometry& geometry);

/// Parses a header and checks that the file is long enough for the elements it counts.
/// @param bytes at least the header
/// @param size bytes of the whole file
/// @throws IoError naming the line
PlyHeader parsePlyHeader(const std::filesystem::path& path, std::string_view bytes, std::size_t size);

}  // namespace tufted::io
