#include "io/off_binary.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include "io/errors.h"
#include "io/polygon_soup.h"

// Decodes the binary form of OFF (Geomview's manual, OFF, "binary format"). CGAL 5.5, which reads this form too, turns
// counts into floats and those into integers beyond their range.
namespace tufted::io {
namespace {

class BinaryOff {
 public:
  BinaryOff(const std::filesystem::path& path, std::string_view bytes, std::size_t body, const OffLayout& layout,
            const Progress& progress)
      : path_(path), bytes_(bytes), offset_(body), layout_(layout), progress_(progress) {}

  Geometry read() {
    const std::int64_t vertices = integer(), faces = integer();
    integer();  // number of edges, which is not needed
    const std::size_t vertex_values = layout_.behindNormal() + (layout_.colors ? 4 : 0) + (layout_.texture ? 2 : 0);
    constexpr std::int64_t least_face = 8;  // no corner, no colour
    // Both counts are below 2^31.
    if (vertices < 0 || faces < 0 ||
        static_cast<std::uint64_t>(vertices) * vertex_values * 4 + static_cast<std::uint64_t>(faces * least_face) >
            bytes_.size() - offset_)
      refuseByte(path_, bytes_.size(),
                 "too short for the " + std::to_string(vertices) + " vertices and " + std::to_string(faces) +
                     " faces of its header");
    Geometry geometry;
    geometry.width = static_cast<int>(vertices);
    geometry.points.resize(vertices, 3);
    if (layout_.normals) geometry.normals.resize(vertices, 3);
    readVertices(geometry);
    PolygonSoup soup;
    soup.place_name = "byte";
    soup.reserve(faces);
    for (std::int64_t f = 0; f < faces; ++f) readFace(soup);
    setPolygons(path_, soup, progress_, geometry);
    return geometry;
  }

 private:
  std::int32_t integer() {
    if (bytes_.size() - offset_ < 4) refuseByte(path_, bytes_.size(), "ends inside a number");
    std::uint32_t value = 0;
    for (int b = 0; b < 4; ++b) value = value << 8 | static_cast<std::uint8_t>(bytes_[offset_ + b]);
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

  /// The number of corners, the corners, the number of colour values, the colour.
  void readFace(PolygonSoup& soup) {
    const std::size_t begin = offset_;
    std::vector<int> polygon(count(begin, "corners"));
    for (int& corner : polygon) corner = integer();
    offset_ += 4 * count(begin, "colour values");
    soup.polygons.push_back(std::move(polygon));
    soup.places.push_back(static_cast<std::int64_t>(begin));
  }

  /// A number of values that the rest of the file can hold.
  std::size_t count(std::size_t face, const char* what) {
    const std::int32_t value = integer();
    if (value < 0 || static_cast<std::size_t>(value) > (bytes_.size() - offset_) / 4)
      refuseByte(path_, face, "a face of " + std::to_string(value) + " " + what);
    return static_cast<std::size_t>(value);
  }

  const std::filesystem::path& path_;
  std::string_view bytes_;
  std::size_t offset_;
  OffLayout layout_;
  const Progress& progress_;
};

}  // namespace

Geometry readBinaryOff(const std::filesystem::path& path, std::string_view bytes, std::size_t body,
                       const OffLayout& layout, const Progress& progress) {
  return BinaryOff(path, bytes, std::min(body, bytes.size()), layout, progress).read();
}

}  // namespace tufted::io
