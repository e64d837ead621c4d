#include "io/ply_writer.h"

#include <algorithm>
#include <cstring>
#include <deque>
#include <string>
#include <vector>

#include "io/columns.h"
#include "io/output_file.h"

namespace tufted::io {
namespace {

/// A property of the vertices: where its values lie in memory, in the machine's little endian order (see npy.cpp).
struct Property {
  std::string name;
  const char* type;
  const std::byte* first;
  std::size_t bytes, stride;
};

const char* plyType(FieldType type) {
  switch (type) {
    case FieldType::int8:
      return "char";
    case FieldType::uint8:
      return "uchar";
    case FieldType::int16:
      return "short";
    case FieldType::uint16:
      return "ushort";
    case FieldType::int32:
      return "int";
    case FieldType::uint32:
      return "uint";
    case FieldType::float32:
      return "float";
    default:
      return "double";
  }
}

/// Collects the properties, each name once: the first to come has it.
class Properties {
 public:
  template <class T>
  void add(const std::string& name, const char* type, const T* first, std::size_t stride = sizeof(T)) {
    insert({name, type, reinterpret_cast<const std::byte*>(first), sizeof(T), stride});
  }

  void addTriple(const char* const (&names)[3], const Points& values) {
    for (int c = 0; c < 3; ++c) add(names[c], "double", values.data() + c, 3 * sizeof(double));
  }

  void addField(const Field& field, std::int64_t rows) {
    const std::size_t size = sizeOf(field.type);
    if ((field.name == "rgb" || field.name == "rgba") && field.count == 1 && size == 4) return addColor(field);
    const bool wide = field.type == FieldType::int64 || field.type == FieldType::uint64;
    const std::byte* first = wide ? toDouble(field, rows) : field.bytes.data();
    for (int c = 0; c < field.count; ++c)
      insert({field.count == 1 ? field.name : field.name + "_" + std::to_string(c), plyType(field.type),
              first + c * size, size, field.count * size});
  }

  const std::vector<Property>& all() const { return properties_; }

 private:
  void insert(const Property& property) {
    const auto same = [&](const Property& other) { return other.name == property.name; };
    if (std::none_of(properties_.begin(), properties_.end(), same)) properties_.push_back(property);
  }

  /// PCL packs a colour as 0xAARRGGBB.
  void addColor(const Field& field) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(field.bytes.data());
    add("red", "uchar", bytes + 2, 4);
    add("green", "uchar", bytes + 1, 4);
    add("blue", "uchar", bytes, 4);
    if (field.name == "rgba") add("alpha", "uchar", bytes + 3, 4);
  }

  const std::byte* toDouble(const Field& field, std::int64_t rows) {
    std::vector<double>& values = converted_.emplace_back(rows * field.count);
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = valueOf(field.type, field.bytes.data() + i * sizeOf(field.type));
    return reinterpret_cast<const std::byte*>(values.data());
  }

  std::vector<Property> properties_;
  std::deque<std::vector<double>> converted_;
};

/// Gathers small pieces before they go to the file.
class Buffer {
 public:
  explicit Buffer(OutputFile& file) : file_(file) { bytes_.reserve(capacity + 64); }
  void append(const void* bytes, std::size_t size) {
    const auto* begin = static_cast<const std::byte*>(bytes);
    bytes_.insert(bytes_.end(), begin, begin + size);
    if (bytes_.size() >= capacity) flush();
  }
  void flush() {
    file_.write(bytes_.data(), bytes_.size());
    bytes_.clear();
  }

 private:
  static constexpr std::size_t capacity = 1 << 20;
  OutputFile& file_;
  std::vector<std::byte> bytes_;
};

std::string header(const std::vector<Property>& properties, const Geometry& geometry) {
  std::string text = "ply\nformat binary_little_endian 1.0\ncomment tufted: mass is an area, status 0 takes part\n";
  if (geometry.height > 1) {
    text += "obj_info num_cols " + std::to_string(geometry.width) + "\n";
    text += "obj_info num_rows " + std::to_string(geometry.height) + "\n";
  }
  text += "element vertex " + std::to_string(geometry.points.rows()) + "\n";
  for (const Property& property : properties)
    text += "property " + std::string(property.type) + " " + property.name + "\n";
  if (geometry.is_mesh)
    text += "element face " + std::to_string(geometry.triangles.rows()) + "\nproperty list uchar int vertex_indices\n";
  return text + "end_header\n";
}

}  // namespace

void writePly(const std::filesystem::path& path, const std::filesystem::path& shown, const Laplacian& laplacian,
              const Geometry& geometry) {
  Properties properties;
  properties.addTriple({"x", "y", "z"}, geometry.points);
  const Points& normals = geometry.normals.rows() > 0 ? geometry.normals : laplacian.frames.normals;
  if (normals.rows() == geometry.points.rows()) properties.addTriple({"nx", "ny", "nz"}, normals);
  for (const Field& field : geometry.fields) {
    const auto ours = {"mass", "boundary", "status", "representative"};
    if (std::find(ours.begin(), ours.end(), field.name) == ours.end())
      properties.addField(field, geometry.points.rows());
  }
  properties.add("mass", "double", laplacian.M.data());
  properties.add("boundary", "uchar", laplacian.boundary.data());
  properties.add("status", "uchar", reinterpret_cast<const std::uint8_t*>(laplacian.status.data()));
  properties.add("representative", "int", laplacian.representative.data());

  OutputFile file(path, shown);
  file.write(header(properties.all(), geometry));
  Buffer buffer(file);
  for (Eigen::Index i = 0; i < geometry.points.rows(); ++i)
    for (const Property& property : properties.all())
      buffer.append(property.first + i * property.stride, property.bytes);
  if (geometry.is_mesh) {
    const std::uint8_t corners = 3;
    for (Eigen::Index f = 0; f < geometry.triangles.rows(); ++f) {
      buffer.append(&corners, 1);
      buffer.append(geometry.triangles.data() + 3 * f, 3 * sizeof(int));
    }
  }
  buffer.flush();
  file.close();
}

}  // namespace tufted::io
