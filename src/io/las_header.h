#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "tufted/io/read.h"

namespace tufted::io {

/// Values of a point record beyond those of its format, as an Extra Bytes record describes them (LAS 1.4, 2.6).
struct LasExtra {
  std::string name;
  FieldType type = FieldType::uint8;
  int count = 1;
  bool scaled = false;  ///< the value is stored * scale + offset, in double
  std::array<double, 3> scale = {1, 1, 1}, offset = {0, 0, 0};
};

/// The public header block of a LAS file, versions 1.0 to 1.4, and the description of its point records.
struct LasHeader {
  int minor = 2;                 ///< the version is 1.minor
  int point_format = 0;          ///< 0 to 10
  std::size_t record_bytes = 0;  ///< bytes per point
  std::int64_t points = 0;
  std::size_t body = 0;  ///< byte at which the points begin
  std::size_t end = 0;   ///< byte at which records behind the points begin, or where the file ends
  std::array<double, 3> scale = {}, offset = {};
  std::vector<LasExtra> extras;  ///< in the order of their bytes, all bytes behind the format's own
};

/// Number of bytes of a point of format 0 to 10, without extra bytes.
std::size_t lasPointBytes(int point_format);

/// Parses a header and checks that the file is long enough for the points it counts.
/// @param bytes the whole file
/// @throws IoError naming the byte
LasHeader parseLasHeader(const std::filesystem::path& path, std::string_view bytes);

}  // namespace tufted::io
