#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numeric>
#include <unordered_map>

#include "io/errors.h"
#include "io/field_names.h"
#include "io/formats.h"
#include "io/line_scanner.h"
#include "io/unread.h"

namespace tufted::io {
namespace {

constexpr std::size_t header_bytes = 84;  // 80 bytes of any text, then the number of triangles
constexpr std::size_t facet_bytes = 50;   // normal, three corners, two bytes of attributes
/// So many bytes at the start of a file tell text from a binary STL, which has a zero byte within its first two
/// triangles.
constexpr std::size_t most_of_name = 1024;

using Position = std::array<double, 3>;

struct PositionHash {
  std::size_t operator()(const Position& position) const {
    std::uint64_t hash = 0;
    for (const double c : position) {
      // Adding zero turns -0 into 0, so that equal numbers have equal hashes.
      hash = (hash ^ std::bit_cast<std::uint64_t>(c + 0.0)) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 32;
    }
    return hash;
  }
};

/// Gives equal corners of a soup of triangles one number, in the order in which they come, and counts the others as
/// `merged_vertices`. Corners that are not finite stay apart.
/// @param geometry a mesh with points and triangles only
void weld(Geometry& geometry) {
  Points& points = geometry.points;
  std::vector<int> vertex(static_cast<std::size_t>(points.rows()));
  std::unordered_map<Position, int, PositionHash> seen;
  seen.reserve(vertex.size());
  int kept = 0;
  for (std::size_t i = 0; i < vertex.size(); ++i) {
    const Position position = {points(i, 0), points(i, 1), points(i, 2)};
    vertex[i] = kept;
    // Corners that are not finite are never merged.
    if (points.row(i).allFinite()) {
      const auto [entry, inserted] = seen.try_emplace(position, kept);
      vertex[i] = entry->second;
      if (!inserted) continue;
    }
    points.row(kept++) = points.row(i);  // kept <= i, so nothing is overwritten too early
  }
  geometry.merged_vertices = points.rows() - kept;
  points.conservativeResize(kept, 3);
  for (int& corner : geometry.triangles.reshaped()) corner = vertex[corner];
  geometry.width = kept;
}

/// Corners of triangles; each three in a row are a triangle.
class Soup {
 public:
  explicit Soup(const std::filesystem::path& path) : path_(path) {}

  void add(const std::array<double, 3>& corner) {
    if (corners_.size() / 3 == static_cast<std::size_t>(std::numeric_limits<int>::max()))
      refuse(path_, "more than 2^31 - 1 corners");
    corners_.insert(corners_.end(), corner.begin(), corner.end());
  }

  /// The mesh of the triangles, in which equal corners are one vertex.
  Geometry geometry() const {
    const auto corners = static_cast<Eigen::Index>(corners_.size() / 3);
    Geometry geometry;
    geometry.points = Eigen::Map<const Points>(corners_.data(), corners, 3);
    geometry.width = static_cast<int>(corners);
    geometry.is_mesh = corners > 0;
    geometry.triangles.resize(corners / 3, 3);
    std::iota(geometry.triangles.data(), geometry.triangles.data() + corners, 0);
    weld(geometry);
    return geometry;
  }

 private:
  const std::filesystem::path& path_;
  std::vector<double> corners_;
};

std::uint32_t binaryCount(std::string_view bytes) {
  std::uint32_t count = 0;
  if (bytes.size() >= header_bytes) std::memcpy(&count, bytes.data() + 80, sizeof(count));
  return count;
}

/// Whether the file is long enough for the count in bytes 80 to 83. Text there would be too large a count below 7 GB.
bool isBinary(std::string_view bytes) {
  return bytes.size() >= header_bytes && (bytes.size() - header_bytes) / facet_bytes >= binaryCount(bytes);
}

/// The first word of each of the first two lines, in lower case.
std::array<std::string, 2> firstWords(std::string_view bytes) {
  const std::filesystem::path nowhere;
  LineScanner scanner(nowhere, bytes.substr(0, most_of_name));
  std::array<std::string, 2> words;
  for (std::string& word : words)
    if (scanner.next()) word = lower(scanner.tokens()[0]);
  return words;
}

/// Whether the file is text. A binary file may begin with `solid` too, and a truncated one is too short for its count.
/// Text with another first word counts as text, so that the error names that word.
bool isAscii(std::string_view bytes) {
  if (isBinary(bytes)) return false;
  const auto [first, second] = firstWords(bytes);
  if (first == "solid" && isOneOf(second, {"facet", "endsolid", "end"})) return true;
  const std::string_view start = bytes.substr(0, most_of_name);
  if (first == "solid") return start.find('\0') == std::string_view::npos;
  return std::all_of(start.begin(), start.end(),
                     [](char c) { return (c >= ' ' && c <= '~') || (c >= '\t' && c <= '\r'); });
}

/// @return byte at which the last triangle ends
std::size_t readBinary(const std::filesystem::path& path, std::string_view bytes, Soup& soup) {
  if (bytes.size() < header_bytes) refuseByte(path, bytes.size(), "ends there, neither ascii nor binary STL");
  const std::uint64_t count = binaryCount(bytes);
  const std::size_t end = header_bytes + facet_bytes * count;
  if (bytes.size() < end)
    refuseByte(path, bytes.size(), "ends there; " + std::to_string(count) + " triangles need " + std::to_string(end));
  for (std::uint64_t f = 0; f < count; ++f) {
    float values[12];  // the normal, then the corners
    std::memcpy(values, bytes.data() + header_bytes + facet_bytes * f, sizeof(values));
    for (int c = 3; c < 12; c += 3) soup.add({values[c], values[c + 1], values[c + 2]});
  }
  return end;
}

/// Reads all solids.
/// @return whether a line follows that begins no solid; it is then the scanner's current line
bool readAscii(LineScanner& scanner, Soup& soup) {
  bool in_solid = false, any = false;
  int corners = -1;  // of the open facet
  while (scanner.next()) {
    const auto& tokens = scanner.tokens();
    std::string word = lower(tokens[0]);
    if (word == "end" && tokens.size() > 1 && isOneOf(lower(tokens[1]), {"loop", "facet", "solid"}))
      word += lower(tokens[1]);
    if (word == "solid") {
      in_solid = true;
    } else if (!in_solid) {
      if (any) return true;
      scanner.refuse(quote(tokens[0]) + " where an ascii STL begins with 'solid'");
    } else if (word == "vertex") {
      if (tokens.size() != 4) scanner.refuse("three coordinates expected");
      if (corners < 0 || corners == 3) scanner.refuse("a vertex outside a facet of three");
      soup.add({scanner.number(1), scanner.number(2), scanner.number(3)});
      ++corners;
    } else if (word == "facet") {
      if (corners >= 0) scanner.refuse("a facet inside another");
      corners = 0;
      any = true;
    } else if (word == "endfacet") {
      if (corners != 3) scanner.refuse("a facet without three vertices");
      corners = -1;
    } else if (word == "endsolid" || word == "end") {
      if (corners >= 0) scanner.refuse("ends inside a facet");
      in_solid = false;
    } else if (word != "outer" && word != "endloop") {
      scanner.refuse("unknown word " + quote(tokens[0]));
    }
  }
  if (in_solid) scanner.refuse("ends inside a solid");
  if (!any) scanner.refuse("holds no facets up to there");
  return false;
}

}  // namespace

bool looksLikeStl(std::string_view bytes) {
  if (!isBinary(bytes)) return firstWords(bytes)[0] == "solid" && isAscii(bytes);
  return bytes.size() - header_bytes - facet_bytes * binaryCount(bytes) < facet_bytes;
}

Geometry readStl(const std::filesystem::path& path, std::string_view bytes) {
  Soup soup(path);
  const bool ascii = isAscii(bytes);
  LineScanner scanner(path, bytes);
  const bool goes_on = ascii && readAscii(scanner, soup);
  const std::size_t end = ascii ? bytes.size() : readBinary(path, bytes, soup);
  Geometry geometry = soup.geometry();
  geometry.format = ascii ? "STL, ascii" : "STL, binary";
  if (goes_on)
    noteUnreadFromHere(path, bytes, scanner, geometry);
  else
    noteUnread(path, bytes, end, geometry);
  return geometry;
}

}  // namespace tufted::io
