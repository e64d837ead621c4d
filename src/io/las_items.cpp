#include <iterator>

#include "io/las_header.h"

namespace tufted::io {
namespace {

constexpr LasItem first_formats[] = {  // point formats 0 to 5
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

constexpr LasItem later_formats[] = {  // point formats 6 to 10
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

}  // namespace

std::vector<LasItem> lasItems(int format) {
  std::vector<LasItem> items;
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

}  // namespace tufted::io
