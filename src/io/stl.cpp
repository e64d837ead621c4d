#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <unordered_map>

#include "io/errors.h"
#include "io/file_text.h"
#include "io/formats.h"
#include "io/line_scanner.h"

namespace tufted::io {
namespace {

constexpr std::size_t header_bytes = 84;  // 80 of any text, then the number of triangles
constexpr std::size_t facet_bytes = 50;   // the normal, three corners, two bytes of attributes

struct CornerHash {
  std::size_t operator()(const std::array<double, 3>& corner) const {
    std::uint64_t hash = 0;
    for (const double c : corner) {
      // Adding zero makes -0 the same as 0, which compare equal.
      hash = (hash ^ std::bit_cast<std::uint64_t>(c + 0.0)) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 32;
    }
    return hash;
  }
};

/// Gives equal corners one vertex, numbered by first occurrence. Corners that are not finite stay apart (CGAL 5.5
/// merges a NaN with any other corner).
class CornerMerger {
 public:
  int vertex(const std::array<double, 3>& corner) {
    const int next = static_cast<int>(coordinates_.size() / 3);
    if (std::isfinite(corner[0]) && std::isfinite(corner[1]) && std::isfinite(corner[2])) {
      const auto [entry, inserted] = vertices_.try_emplace(corner, next);
      if (!inserted) return entry->second;
    }
    coordinates_.insert(coordinates_.end(), corner.begin(), corner.end());
    return next;
  }

  Points points() const {
    return Eigen::Map<const Points>(coordinates_.data(), static_cast<Eigen::Index>(coordinates_.size() / 3), 3);
  }

 private:
  std::vector<double> coordinates_;
  std::unordered_map<std::array<double, 3>, int, CornerHash> vertices_;
};

/// Corners of all triangles as vertex numbers.
class Soup {
 public:
  explicit Soup(const std::filesystem::path& path) : path_(path) {}

  void add(const std::array<double, 3>& corner) {
    if (corners_.size() == static_cast<std::size_t>(std::numeric_limits<int>::max()))
      refuse(path_, "more than 2^31 - 1 corners");
    corners_.push_back(merger_.vertex(corner));
  }
  std::size_t size() const { return corners_.size(); }

  Geometry geometry() const {
    Geometry geometry;
    geometry.points = merger_.points();
    geometry.width = static_cast<int>(geometry.points.rows());
    geometry.is_mesh = !corners_.empty();
    geometry.triangles =
        Eigen::Map<const Triangles>(corners_.data(), static_cast<Eigen::Index>(corners_.size() / 3), 3);
    geometry.merged_vertices = static_cast<std::int64_t>(corners_.size()) - geometry.points.rows();
    return geometry;
  }

 private:
  const std::filesystem::path& path_;
  CornerMerger merger_;
  std::vector<int> corners_;
};

std::uint32_t binaryCount(std::string_view bytes) {
  std::uint32_t count = 0;
  if (bytes.size() >= header_bytes) std::memcpy(&count, bytes.data() + 80, sizeof(count));
  return count;
}

/// Binary files may begin with `solid` as well, but only by chance do they have the length their count asks for.
bool isAscii(std::string_view bytes) {
  if (bytes.size() >= header_bytes && bytes.size() == header_bytes + facet_bytes * binaryCount(bytes)) return false;
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

Geometry readStl(const std::filesystem::path& path) {
  const std::string bytes = readBytes(path);
  Soup soup(path);
  if (isAscii(bytes))
    readAscii(path, bytes, soup);
  else
    readBinary(path, bytes, soup);
  return soup.geometry();
}

}  // namespace tufted::io
