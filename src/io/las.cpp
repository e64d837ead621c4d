#include <bit>
#include <cmath>
#include <cstring>

#include "io/columns.h"
#include "io/errors.h"
#include "io/formats.h"
#include "io/las_header.h"
#include "io/unread.h"

// Reads the points of LAS files (ASPRS, LAS Specification 1.4 R15, Tables 10 to 22). PDAL, Debian's only library for
// LAS, is larger than all other dependencies together.
namespace tufted::io {
namespace {

/// The place of a value in a point record: some bytes, or some bits of one byte.
struct Item {
  const char* name;
  FieldType type;
  int byte;
  int first_bit = 0;
  int bits = 0;  ///< 0: the whole value
};

constexpr Item first_formats[] = {  // point formats 0 to 5
    {"intensity", FieldType::uint16, 12},
    {"return_number", FieldType::uint8, 14, 0, 3},
    {"number_of_returns", FieldType::uint8, 14, 3, 3},
    {"scan_direction", FieldType::uint8, 14, 6, 1},
    {"edge_of_flight_line", FieldType::uint8, 14, 7, 1},
    {"classification", FieldType::uint8, 15, 0, 5},
    {"synthetic", FieldType::uint8, 15, 5, 1},
    {"key_point", FieldType::uint8, 15, 6, 1},
    {"withheld", FieldType::uint8, 15, 7, 1},
    {"scan_angle_rank", FieldType::int8, 16},
    {"user_data", FieldType::uint8, 17},
    {"point_source_id", FieldType::uint16, 18}};

constexpr Item later_formats[] = {  // point formats 6 to 10
    {"intensity", FieldType::uint16, 12},
    {"return_number", FieldType::uint8, 14, 0, 4},
    {"number_of_returns", FieldType::uint8, 14, 4, 4},
    {"synthetic", FieldType::uint8, 15, 0, 1},
    {"key_point", FieldType::uint8, 15, 1, 1},
    {"withheld", FieldType::uint8, 15, 2, 1},
    {"overlap", FieldType::uint8, 15, 3, 1},
    {"scanner_channel", FieldType::uint8, 15, 4, 2},
    {"scan_direction", FieldType::uint8, 15, 6, 1},
    {"edge_of_flight_line", FieldType::uint8, 15, 7, 1},
    {"classification", FieldType::uint8, 16},
    {"user_data", FieldType::uint8, 17},
    {"scan_angle", FieldType::int16, 18},  // in 0.006 degrees
    {"point_source_id", FieldType::uint16, 20},
    {"gps_time", FieldType::float64, 22}};

/// The items of a point format in the order of their bytes.
std::vector<Item> itemsOf(int format) {
  std::vector<Item> items;
  const auto add = [&items](const char* name, FieldType type, int byte) { items.push_back({name, type, byte}); };
  const auto addColor = [&add](int byte) {
    add("red", FieldType::uint16, byte);
    add("green", FieldType::uint16, byte + 2);
    add("blue", FieldType::uint16, byte + 4);
  };
  if (format < 6)
    items.assign(std::begin(first_formats), std::end(first_formats));
  else
    items.assign(std::begin(later_formats), std::end(later_formats));
  if (format == 1 || format == 3 || format == 4 || format == 5) add("gps_time", FieldType::float64, 20);
  if (format == 2) addColor(20);
  if (format == 3 || format == 5) addColor(28);
  if (format == 7 || format == 8 || format == 10) addColor(30);
  if (format == 8 || format == 10) add("nir", FieldType::uint16, 36);
  if (format == 4 || format == 5 || format == 9 || format == 10) {
    const int byte = static_cast<int>(lasPointBytes(format)) - 29;
    add("wave_packet_descriptor", FieldType::uint8, byte);
    add("wave_packet_offset", FieldType::uint64, byte + 1);
    add("wave_packet_bytes", FieldType::uint32, byte + 9);
    add("wave_return_location", FieldType::float32, byte + 13);
    add("wave_x", FieldType::float32, byte + 17);
    add("wave_y", FieldType::float32, byte + 21);
    add("wave_z", FieldType::float32, byte + 25);
  }
  return items;
}

/// The point records of a file, `count` of `bytes` bytes each.
struct Records {
  const char* first;
  std::size_t bytes;
  std::int64_t count;

  const char* at(std::int64_t i, std::size_t byte) const { return first + i * bytes + byte; }
};

Field makeField(std::string name, FieldType type, int count, std::int64_t points) {
  Field field = {std::move(name), type, count, {}};
  field.bytes.resize(points * count * sizeOf(type));
  return field;
}

Field readItem(const Item& item, const Records& records) {
  Field field = makeField(item.name, item.type, 1, records.count);
  const std::size_t size = sizeOf(item.type);
  for (std::int64_t i = 0; i < records.count; ++i) {
    std::byte* value = field.bytes.data() + i * size;
    std::memcpy(value, records.at(i, item.byte), size);
    if (item.bits > 0) *value = (*value >> item.first_bit) & std::byte((1 << item.bits) - 1);
  }
  return field;
}

Field readExtra(const LasExtra& extra, std::size_t byte, const Records& records) {
  const std::size_t size = sizeOf(extra.type);
  Field field = makeField(extra.name, extra.scaled ? FieldType::float64 : extra.type, extra.count, records.count);
  for (std::int64_t i = 0; i < records.count; ++i) {
    for (int c = 0; c < extra.count; ++c) {
      std::byte stored[sizeof(double)];
      std::memcpy(stored, records.at(i, byte + c * size), size);
      if (extra.scaled) {
        const double value = valueOf(extra.type, stored) * extra.scale[c] + extra.offset[c];
        std::memcpy(field.bytes.data() + (i * extra.count + c) * sizeof(double), &value, sizeof(double));
      } else {
        std::memcpy(field.bytes.data() + (i * extra.count + c) * size, stored, size);
      }
    }
  }
  return field;
}

}  // namespace

Geometry readLas(const std::filesystem::path& path, std::string_view bytes) {
  static_assert(std::endian::native == std::endian::little, "the values are taken as they lie in the file");
  const LasHeader header = parseLasHeader(path, bytes);
  const Records records = {bytes.data() + header.body, header.record_bytes, header.points};
  Geometry geometry;
  geometry.format = "LAS 1." + std::to_string(header.minor) + ", point format " + std::to_string(header.point_format);
  geometry.width = static_cast<int>(header.points);
  geometry.points.resize(header.points, 3);
  for (std::int64_t i = 0; i < header.points; ++i) {
    std::int32_t stored[3];
    std::memcpy(stored, records.at(i, 0), sizeof(stored));
    for (int c = 0; c < 3; ++c) geometry.points(i, c) = stored[c] * header.scale[c] + header.offset[c];
  }
  for (const Item& item : itemsOf(header.point_format)) geometry.fields.push_back(readItem(item, records));
  std::size_t byte = lasPointBytes(header.point_format);
  for (const LasExtra& extra : header.extras) {
    geometry.fields.push_back(readExtra(extra, byte, records));
    byte += sizeOf(extra.type) * extra.count;
  }
  noteUnread(path, bytes.substr(0, header.end),
             header.body + static_cast<std::size_t>(header.points) * header.record_bytes, geometry);
  return geometry;
}

}  // namespace tufted::io
