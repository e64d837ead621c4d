#include "io/off_binary.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>

#include "io/errors.h"
#include "io/polygon_soup.h"
#include "io/unread.h"
#include "tufted/errors.h"

// Decodes the binary form of OFF (Geomview's manual, OFF, "binary format"). Not by CGAL 5.5, which converts counts
// through floats to integers that they do not fit into. pmp-library writes it in the byte order of its machine, and
// faces without colours.
namespace tufted::io {
namespace {

struct Dialect {
  bool is_little_endian;
  bool has_face_colors;
};

class BinaryOff {
 public:
  BinaryOff(const std::filesystem::path& path, std::string_view bytes, std::size_t body, const OffLayout& layout,
            const Progress& progress)
      : path_(path), bytes_(bytes), body_(body), layout_(layout), progress_(progress) {}

  Geometry read() {
    chooseDialect();
    begin();
    Geometry geometry;
    geometry.format = dialect_.is_little_endian ? "OFF, binary little endian" : "OFF, binary";
    geometry.width = static_cast<int>(vertices_);
    geometry.points.resize(vertices_, 3);
    if (layout_.normals) geometry.normals.resize(vertices_, 3);
    readVertices(geometry);
    PolygonSoup soup;
    soup.place_name = "byte";
    soup.reserve(faces_);
    for (std::int64_t f = 0; f < faces_; ++f) readFace(soup);
    noteUnread(path_, bytes_, offset_, geometry);
    setPolygons(path_, soup, progress_, geometry);
    return geometry;
  }

 private:
  /// Chooses the first dialect in which the faces end where the file ends, otherwise the first in which all faces are
  /// valid, otherwise the standard one, whose errors are then reported.
  void chooseDialect() {
    constexpr Dialect standard = {false, true};
    std::optional<Dialect> whole;
    for (const Dialect dialect : {standard, Dialect{false, false}, Dialect{true, true}, Dialect{true, false}}) {
      dialect_ = dialect;
      const std::optional<std::size_t> least = leastCorners();
      if (!least) continue;
      const bool are_polygons = *least >= 3;  // in a wrong dialect zeros look like faces without corners
      const bool is_standard = !dialect.is_little_endian && dialect.has_face_colors;
      if (offset_ == bytes_.size() && (are_polygons || is_standard)) return;
      if (!whole && are_polygons) whole = dialect;
    }
    dialect_ = whole.value_or(standard);
  }

  /// The least number of corners of a face; nullopt if a face exceeds the file or has a vertex out of range.
  std::optional<std::size_t> leastCorners() {
    std::size_t least = std::numeric_limits<std::size_t>::max();
    try {
      begin();
      offset_ += static_cast<std::size_t>(vertices_) * vertexBytes();
      for (std::int64_t f = 0; f < faces_; ++f) {
        const std::size_t corners = count(offset_, "corners");
        least = std::min(least, corners);
        for (std::size_t c = 0; c < corners; ++c)
          if (const std::int32_t vertex = integer(); vertex < 0 || vertex >= vertices_) return std::nullopt;
        skipColor();
      }
      return least;
    } catch (const IoError&) {
      return std::nullopt;
    }
  }

  std::size_t vertexBytes() const {
    return 4 * (layout_.behindNormal() + (layout_.colors ? 4 : 0) + (layout_.texture ? 2 : 0));
  }

  /// Reads the counts, and checks that the rest of the file is long enough for them.
  void begin() {
    offset_ = body_;
    vertices_ = integer();
    faces_ = integer();
    integer();                              // number of edges, not used
    constexpr std::int64_t least_face = 4;  // bytes of a face without corners
    // No overflow: both counts are below 2^31.
    if (vertices_ < 0 || faces_ < 0 ||
        static_cast<std::uint64_t>(vertices_) * vertexBytes() + static_cast<std::uint64_t>(faces_ * least_face) >
            bytes_.size() - offset_)
      refuseByte(path_, bytes_.size(),
                 "too short for the " + std::to_string(vertices_) + " vertices and " + std::to_string(faces_) +
                     " faces of its header");
  }

  std::int32_t integer() {
    if (bytes_.size() - offset_ < 4) refuseByte(path_, bytes_.size(), "ends inside a number");
    std::uint32_t value = 0;
    for (int b = 0; b < 4; ++b)
      value = value << 8 | static_cast<std::uint8_t>(bytes_[offset_ + (dialect_.is_little_endian ? 3 - b : b)]);
    offset_ += 4;
    return static_cast<std::int32_t>(value);
  }
  float number() { return std::bit_cast<float>(integer()); }

  void readVertices(Geometry& geometry) {
    constexpr const char* names[] = {"red", "green", "blue", "alpha"};
    if (layout_.colors)
      for (const char* name : names) {
        geometry.fields.push_back({name, FieldType::float32, 1, {}});
        geometry.fields.back().bytes.resize(geometry.points.rows() * sizeof(float));
      }
    for (Eigen::Index v = 0; v < geometry.points.rows(); ++v) {
      for (int c = 0; c < 3; ++c) geometry.points(v, c) = number();
      if (layout_.homogeneous) geometry.points.row(v) /= number();
      if (layout_.normals)
        for (int c = 0; c < 3; ++c) geometry.normals(v, c) = number();
      for (Field& field : geometry.fields) {
        const float value = number();
        std::memcpy(field.bytes.data() + v * sizeof(float), &value, sizeof(float));
      }
      if (layout_.texture) offset_ += 8;
    }
  }

  /// Reads the number of corners and the corners, and skips the number of colour values and the colour.
  void readFace(PolygonSoup& soup) {
    const std::size_t begin = offset_;
    std::vector<int> polygon(count(begin, "corners"));
    for (int& corner : polygon) corner = integer();
    skipColor();
    soup.add(std::move(polygon), static_cast<std::int64_t>(begin));
  }

  void skipColor() {
    if (dialect_.has_face_colors) offset_ += 4 * count(offset_, "colour values");
  }

  /// Reads a number of values of the face at byte `face`, and checks that the rest of the file can hold them.
  std::size_t count(std::size_t face, const char* what) {
    const std::int32_t value = integer();
    if (value < 0 || static_cast<std::size_t>(value) > (bytes_.size() - offset_) / 4)
      refuseByte(path_, face, "a face of " + std::to_string(value) + " " + what);
    return static_cast<std::size_t>(value);
  }

  const std::filesystem::path& path_;
  std::string_view bytes_;
  std::size_t body_;
  std::size_t offset_ = 0;
  std::int64_t vertices_ = 0, faces_ = 0;
  Dialect dialect_ = {};
  OffLayout layout_;
  const Progress& progress_;
};

}  // namespace

Geometry readBinaryOff(const std::filesystem::path& path, std::string_view bytes, std::size_t body,
                       const OffLayout& layout, const Progress& progress) {
  return BinaryOff(path, bytes, std::min(body, bytes.size()), layout, progress).read();
}

}  // namespace tufted::io
