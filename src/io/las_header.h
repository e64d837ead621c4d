#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "tufted/io/read.h"

namespace tufted::io {

/// A field that point records have in addition to those of their format, described by an Extra Bytes record (LAS 1.4,
/// Section 2.6).
struct LasExtra {
  std::string name;
  FieldType type = FieldType::uint8;
  int count = 1;
  bool scaled = false;  ///< whether a value is what is stored times scale plus offset, in double
  std::array<double, 3> scale = {1, 1, 1}, offset = {0, 0, 0};
};

/// The public header block of a LAS file, versions 1.0 to 1.4, and the description of its point records.
struct LasHeader {
  int minor = 2;                 ///< the version is 1.minor
  int point_format = 0;          ///< 0 to 10
  std::size_t record_bytes = 0;  ///< bytes per point
  std::int64_t points = 0;
  std::size_t body = 0;  ///< byte at which the points begin
  std::size_t end = 0;   ///< byte at which records after the points begin, or size of the file
  std::array<double, 3> scale = {}, offset = {};
  std::vector<LasExtra> extras;  ///< covers all bytes of a record after those of the format, in order
};

/// Bytes of a point record of format 0 to 10, without extra bytes.
std::size_t lasPointBytes(int point_format);

/// Parses a header and checks that the file is long enough for the points it counts.
/// @param bytes the whole file
/// @throws IoError naming the byte
LasHeader parseLasHeader(const std::filesystem::path& path, std::string_view bytes);

}  // namespace tufted::io
