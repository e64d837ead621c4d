#include "las_classes.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>

namespace {

/// Names of ASPRS, LAS Specification 1.4 R15, Table 17.
std::string nameOfClass(int number) {
  constexpr const char* names[] = {"never classified",
                                   "unclassified",
                                   "ground",
                                   "low vegetation",
                                   "medium vegetation",
                                   "high vegetation",
                                   "building",
                                   "low noise",
                                   "model key point",
                                   "water",
                                   "rail",
                                   "road surface",
                                   "overlap",
                                   "wire guard",
                                   "wire conductor",
                                   "transmission tower",
                                   "wire connector",
                                   "bridge deck",
                                   "high noise",
                                   "overhead structure",
                                   "ignored ground",
                                   "snow",
                                   "temporal exclusion"};
  constexpr int first_of_users = 64;
  if (number < std::ssize(names)) return names[number];
  return number < first_of_users ? "reserved" : "user defined";
}

int numberAt(std::string_view bytes, std::size_t at) {
  if (at + 2 > bytes.size()) return 0;
  return static_cast<std::uint8_t>(bytes[at]) + 256 * static_cast<std::uint8_t>(bytes[at + 1]);
}

/// The text between two marks, the second of which may be missing.
std::string between(std::string_view text, char first, char last) {
  const std::size_t begin = text.find(first);
  return begin == text.npos ? "" : std::string(text.substr(begin + 1, text.find(last, begin + 1) - begin - 1));
}

/// A text up to its first NUL, with blanks in place of control characters, which would reach the terminal.
std::string printable(std::string_view text) {
  std::string result(text.substr(0, text.find('\0')));
  for (char& c : result)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  return result;
}

/// The EPSG code of the projected, otherwise of the geographic system, 0 if none is named or the projection is a user's
/// own.
/// @param keys GeoTIFF's GeoKeyDirectoryTag: four numbers, then four of each key, the first its name, the last its
/// value
int epsgCode(std::string_view keys) {
  constexpr int projected = 3072, geographic = 2048, user_defined = 32767;
  int code = 0;
  for (std::size_t at = 8; at + 8 <= keys.size(); at += 8) {
    const int key = numberAt(keys, at), value = numberAt(keys, at + 6);
    if (numberAt(keys, at + 2) != 0) continue;  // the value lies elsewhere
    if (key == projected && value == user_defined) return 0;
    if (value != user_defined && (key == projected || (key == geographic && code == 0))) code = value;
  }
  return code;
}

}  // namespace

std::vector<LasClass> lasClasses(const tufted::Geometry& geometry) {
  std::vector<LasClass> classes;
  const auto field = std::find_if(geometry.fields.begin(), geometry.fields.end(),
                                  [](const tufted::Field& each) { return each.name == "classification"; });
  if (geometry.las_header.empty() || field == geometry.fields.end()) return classes;
  std::array<std::int64_t, 256> counts = {};
  for (const std::byte value : field->bytes) ++counts[std::to_integer<std::size_t>(value)];
  for (int number = 0; number < 256; ++number)
    if (counts[number] > 0) classes.push_back({number, nameOfClass(number), counts[number]});
  return classes;
}

std::string lasReferenceSystem(const tufted::Geometry& geometry) {
  // Section 2.5 of the LAS specification: a record has a head of 54 bytes with user, number and length. The header of a
  // geometry is always that of LAS 1.4.
  constexpr std::size_t header_bytes = 375, head_bytes = 54;
  constexpr int wkt = 2112, geo_keys = 34735, geo_text = 34737;
  std::string_view rest = geometry.las_header;
  rest.remove_prefix(std::min(rest.size(), header_bytes));
  std::string by_wkt, by_code, by_text;
  while (rest.size() >= head_bytes) {
    const bool is_projection = rest.substr(2).starts_with("LASF_Projection");
    const int number = numberAt(rest, 18);
    const auto length = static_cast<std::size_t>(numberAt(rest, 20));
    const std::string_view body = rest.substr(head_bytes, length);
    rest.remove_prefix(std::min(rest.size(), head_bytes + length));
    if (!is_projection) continue;
    if (number == wkt) by_wkt = printable(between(body, '"', '"'));
    if (const int code = number == geo_keys ? epsgCode(body) : 0; code > 0) by_code = "EPSG:" + std::to_string(code);
    if (number == geo_text) by_text = printable(body.substr(0, body.find('|')));
  }
  return !by_wkt.empty() ? by_wkt : !by_code.empty() ? by_code : by_text;
}
