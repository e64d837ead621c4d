#include <algorithm>
#include <bit>
#include <cstring>

#include "io/columns.h"
#include "io/formats.h"
#include "io/las_header.h"
#include "io/unread.h"

// Reads the points of LAS files (ASPRS, LAS Specification 1.4 R15). PDAL, Debian's only library for
// LAS, is larger than all other dependencies together.
namespace tufted::io {
namespace {

/// Points that are read together: 64 bytes each, the longest record of any use, fit the second-level cache, so that the
/// file is read from memory once and not for each field.
constexpr std::int64_t block = 4096;

/// Consecutive point records of a file, `count` of `bytes` bytes each.
struct Records {
  const char* first;
  std::size_t bytes;
  std::int64_t begin;  ///< number of the first
  std::int64_t count;

  const char* at(std::int64_t i, std::size_t byte) const { return first + i * bytes + byte; }
};

void readPositions(const LasHeader& header, const Records& records, Points& points) {
  for (std::int64_t i = 0; i < records.count; ++i) {
    std::int32_t stored[3];
    std::memcpy(stored, records.at(i, 0), sizeof(stored));
    for (int c = 0; c < 3; ++c) points(records.begin + i, c) = stored[c] * header.scale[c] + header.offset[c];
  }
}

void readItem(const LasItem& item, const Records& records, Field& field) {
  const std::size_t size = sizeOf(item.type);
  std::byte* value = field.bytes.data() + records.begin * size;
  for (std::int64_t i = 0; i < records.count; ++i, value += size) {
    std::memcpy(value, records.at(i, item.byte), size);
    if (item.bits > 0) *value = (*value >> item.first_bit) & std::byte((1 << item.bits) - 1);
  }
}

void readExtra(const LasExtra& extra, std::size_t byte, const Records& records, Field& field) {
  const std::size_t size = sizeOf(extra.type), made = sizeOf(field.type);
  std::byte* value = field.bytes.data() + records.begin * extra.count * made;
  for (std::int64_t i = 0; i < records.count; ++i) {
    for (int c = 0; c < extra.count; ++c, value += made) {
      std::byte stored[sizeof(double)];
      std::memcpy(stored, records.at(i, byte + c * size), size);
      if (extra.scaled) {
        const double scaled = valueOf(extra.type, stored) * extra.scale[c] + extra.offset[c];
        std::memcpy(value, &scaled, sizeof(double));
      } else {
        std::memcpy(value, stored, size);
      }
    }
  }
}

}  // namespace

namespace {

/// Drops the fields of the point format whose name an extra value has. Files that we wrote have a field as an extra
/// value if the point format cannot hold it as it is, and zeros in its place.
void dropReplaced(const LasHeader& header, std::vector<Field>& fields) {
  const auto is_replaced = [&](const Field& field) {
    return std::any_of(header.extras.begin(), header.extras.end(),
                       [&](const LasExtra& extra) { return extra.name == field.name; });
  };
  const auto items = static_cast<std::ptrdiff_t>(lasItems(header.point_format).size());
  const auto end = std::remove_if(fields.begin(), fields.begin() + items, is_replaced);
  fields.erase(end, fields.begin() + items);
}

/// All fields, those of the point format first, without values.
Geometry withAllFields(const LasHeader& header) {
  Geometry geometry;
  geometry.format = "LAS 1." + std::to_string(header.minor) + ", point format " + std::to_string(header.point_format);
  geometry.las_header = header.kept;
  for (const LasItem& item : lasItems(header.point_format)) geometry.fields.push_back({item.name, item.type, 1, {}});
  for (const LasExtra& extra : header.extras)
    geometry.fields.push_back({extra.name, extra.scaled ? FieldType::float64 : extra.type, extra.count, {}});
  return geometry;
}

}  // namespace

Geometry lasWithoutPoints(const LasHeader& header) {
  Geometry geometry = withAllFields(header);
  dropReplaced(header, geometry.fields);
  return geometry;
}

Geometry readLas(const std::filesystem::path& path, std::string_view bytes) {
  static_assert(std::endian::native == std::endian::little, "the values are taken as they lie in the file");
  const LasHeader header = parseLasHeader(path, bytes, bytes.size());
  const std::vector<LasItem> items = lasItems(header.point_format);
  Geometry geometry = withAllFields(header);
  geometry.width = static_cast<int>(checkedRows(path, header.points));
  geometry.points.resize(header.points, 3);
  for (Field& field : geometry.fields) field.bytes.resize(header.points * field.count * sizeOf(field.type));
  for (std::int64_t begin = 0; begin < header.points; begin += block) {
    const Records records = {bytes.data() + header.body + begin * header.record_bytes, header.record_bytes, begin,
                             std::min(block, header.points - begin)};
    readPositions(header, records, geometry.points);
    auto field = geometry.fields.begin();
    for (const LasItem& item : items) readItem(item, records, *field++);
    std::size_t byte = lasPointBytes(header.point_format);
    for (const LasExtra& extra : header.extras) {
      readExtra(extra, byte, records, *field++);
      byte += sizeOf(extra.type) * extra.count;
    }
  }
  dropReplaced(header, geometry.fields);
  noteUnread(path, bytes.substr(0, header.end),
             header.body + static_cast<std::size_t>(header.points) * header.record_bytes, geometry);
  return geometry;
}

}  // namespace tufted::io
