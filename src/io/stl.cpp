#include <array>
#include <cstring>
#include <limits>
#include <numeric>

#include "io/errors.h"
#include "io/formats.h"
#include "io/line_scanner.h"
#include "io/weld.h"

namespace tufted::io {
namespace {

constexpr std::size_t header_bytes = 84;  // 80 of any text, then the number of triangles
constexpr std::size_t facet_bytes = 50;   // the normal, three corners, two bytes of attributes

/// The corners of all triangles, three by three.
class Soup {
 public:
  explicit Soup(const std::filesystem::path& path) : path_(path) {}

  void add(const std::array<double, 3>& corner) {
    if (corners_.size() / 3 == static_cast<std::size_t>(std::numeric_limits<int>::max()))
      refuse(path_, "more than 2^31 - 1 corners");
    corners_.insert(corners_.end(), corner.begin(), corner.end());
  }

  /// Equal corners become one vertex.
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

bool isBinary(std::string_view bytes) {
  const std::size_t facets = facet_bytes * binaryCount(bytes);
  return bytes.size() >= header_bytes + facets && bytes.size() < header_bytes + facets + facet_bytes;
}

/// Binary files may begin with `solid` as well, but four letters as a count ask for more than 26 GB.
bool isAscii(std::string_view bytes) {
  if (isBinary(bytes)) return false;
  const std::size_t begin = bytes.find_first_not_of(" \t\r\n");
  return begin != std::string_view::npos && bytes.substr(begin).starts_with("solid");
}

void readBinary(const std::filesystem::path& path, std::string_view bytes, Soup& soup) {
  if (bytes.size() < header_bytes) refuseByte(path, bytes.size(), "ends there, neither ascii nor binary STL");
  const std::uint64_t count = binaryCount(bytes);
  if (bytes.size() < header_bytes + facet_bytes * count)
    refuseByte(path, bytes.size(),
               "ends there; " + std::to_string(count) + " triangles need " +
                   std::to_string(header_bytes + facet_bytes * count));
  if (bytes.size() >= header_bytes + facet_bytes * (count + 1))
    refuseByte(path, header_bytes + facet_bytes * count,
               "more than the " + std::to_string(count) + " triangles of the header");
  for (std::uint64_t f = 0; f < count; ++f) {
    float values[12];  // the normal, then the corners
    std::memcpy(values, bytes.data() + header_bytes + facet_bytes * f, sizeof(values));
    for (int c = 3; c < 12; c += 3) soup.add({values[c], values[c + 1], values[c + 2]});
  }
}

void readAscii(const std::filesystem::path& path, std::string_view text, Soup& soup) {
  LineScanner scanner(path, text);
  bool in_solid = false;
  int corners = -1;  // of the open facet
  while (scanner.next()) {
    const auto& tokens = scanner.tokens();
    if (tokens[0] == "vertex") {
      if (tokens.size() != 4) scanner.refuse("three coordinates expected");
      if (corners < 0 || corners == 3) scanner.refuse("a vertex outside a facet of three");
      soup.add({scanner.number(1), scanner.number(2), scanner.number(3)});
      ++corners;
    } else if (tokens[0] == "facet") {
      if (corners >= 0) scanner.refuse("a facet inside another");
      corners = 0;
    } else if (tokens[0] == "endfacet") {
      if (corners != 3) scanner.refuse("a facet without three vertices");
      corners = -1;
    } else if (tokens[0] == "solid") {
      in_solid = true;
    } else if (tokens[0] == "endsolid" || tokens[0] == "end") {
      in_solid = false;
    }
  }
  if (corners >= 0 || in_solid) scanner.refuse("ends inside a solid");
}

}  // namespace

bool looksLikeStl(std::string_view bytes) {
  return isBinary(bytes) || isAscii(bytes);
}

Geometry readStl(const std::filesystem::path& path, std::string_view bytes) {
  Soup soup(path);
  const bool ascii = isAscii(bytes);
  if (ascii)
    readAscii(path, bytes, soup);
  else
    readBinary(path, bytes, soup);
  Geometry geometry = soup.geometry();
  geometry.format = ascii ? "STL, ascii" : "STL, binary";
  return geometry;
}

}  // namespace tufted::io
