#pragma once

#include <array>
#include <cstdint>
#include <cstring>
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
  /// The header as that of LAS 1.4, and after it the variable length records except those that describe points. Records
  /// after the points become records before them, if they are short enough. See Geometry::las_header.
  std::string kept;
};

// Sizes in bytes, and the places in the public header that both the reader and the writer use.
constexpr std::size_t las_header_bytes = 375;  ///< of LAS 1.4
constexpr std::size_t las_record_header = 54;  ///< of a variable length record
constexpr std::size_t las_descriptor = 192;    ///< of the description of one extra value
namespace las_byte {
constexpr std::size_t global_encoding = 6, version = 24, program = 58, header_bytes = 94, points_begin = 96,
                      records = 100, point_format = 104, point_bytes = 105, old_count = 107, scale = 131, offset = 155,
                      box = 179, waves = 227, later_records = 235, count = 247, count_by_return = 255;
}

/// Stores a value in little endian order over bytes that are there.
template <class T>
void put(std::string& bytes, std::size_t byte, T value) {
  std::memcpy(bytes.data() + byte, &value, sizeof(T));
}

/// Bytes of a point record of format 0 to 10, without extra bytes.
std::size_t lasPointBytes(int point_format);

/// Parses a header and checks that the file is long enough for the points it counts.
/// @param bytes the file as far as its points at least; records after the points are seen if they are there too
/// @param size bytes of the whole file
/// @throws IoError naming the byte
LasHeader parseLasHeader(const std::filesystem::path& path, std::string_view bytes, std::size_t size);

/// What a LAS file holds except its points: format, names of the fields, and Geometry::las_header.
Geometry lasWithoutPoints(const LasHeader& header);

/// The place of a value in a point record of a LAS file: some bytes, or some bits of one byte.
struct LasItem {
  const char* name;
  FieldType type;
  int byte;
  int first_bit = 0;
  int bits = 0;  ///< 0: the whole value
};

/// The items of point format 0 to 10 after x, y, z, in the order of their bytes (ASPRS, LAS Specification 1.4 R15,
/// Tables 10 to 22).
std::vector<LasItem> lasItems(int format);

}  // namespace tufted::io
