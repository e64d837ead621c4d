#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <type_traits>

#include "io/columns.h"
#include "io/output_file.h"
#include "io/point_table.h"
#include "io/point_writers.h"

// Not by PCL's PCDWriter, which takes the sensor's pose as float and prints six digits, so that the sensor of a
// georeferenced scan is metres off, and which needs a copy of all values.
namespace tufted::io {
namespace {

const Field* channel(const Geometry& geometry, const std::string& name) {
  const auto found = std::find_if(geometry.fields.begin(), geometry.fields.end(), [&](const Field& field) {
    return field.name == name && field.type == FieldType::uint8 && field.count == 1;
  });
  return found == geometry.fields.end() ? nullptr : &*found;
}

/// The channels of a colour in the order in which PCL packs them: 0xAARRGGBB from the lowest byte. Null if missing.
struct Color {
  explicit Color(const Geometry& geometry)
      : channels{channel(geometry, "blue"), channel(geometry, "green"), channel(geometry, "red"),
                 channel(geometry, "alpha")} {}

  bool complete() const { return channels[0] && channels[1] && channels[2]; }
  bool has(const Field& field) const {
    return complete() && std::find(channels.begin(), channels.end(), &field) != channels.end();
  }

  std::array<const Field*, 4> channels;
};

void addPacked(PointTable& table, const Color& color) {
  std::byte* const made = table.allocate(4 * table.rows());
  for (std::int64_t i = 0; i < table.rows(); ++i)
    for (std::size_t c = 0; c < 4; ++c)
      made[4 * i + c] = color.channels[c] ? color.channels[c]->bytes[i] : std::byte(0xff);
  table.add({color.channels[3] ? "rgba" : "rgb", FieldType::uint32, 1, made, 4});
}

std::string pcdHeader(const PointTable& table, const Geometry& geometry, const std::vector<Convention>& conventions) {
  std::string fields = "FIELDS", sizes = "SIZE", types = "TYPE", counts = "COUNT";
  for (const PointColumn& column : table.columns()) {
    fields.append(" ").append(column.name);
    sizes.append(" ").append(std::to_string(sizeOf(column.type)));
    types.append(" ").append(1, static_cast<char>(std::toupper(kindOf(column.type))));
    counts.append(" ").append(std::to_string(column.count));
  }
  const bool organized = geometry.height > 1;
  const std::string points = std::to_string(table.rows());
  return "# .PCD v0.7 - Point Cloud Data file format\n" + conventionLines(conventions, "# tufted ", true) +
         "VERSION 0.7\n" + fields + "\n" + sizes + "\n" + types + "\n" + counts + "\nWIDTH " +
         (organized ? std::to_string(geometry.width) : points) + "\nHEIGHT " +
         (organized ? std::to_string(geometry.height) : "1") + "\nVIEWPOINT " + viewpointText(geometry) + "\nPOINTS " +
         points + "\nDATA binary\n";
}

}  // namespace

void writePcd(const OutputPath& to, const Laplacian& laplacian, const Geometry& geometry, const VectorXd& M,
              const std::vector<Convention>& conventions) {
  const Color color(geometry);
  const auto add_field = [&color](PointTable& table, const Field& field) {
    if (!color.has(field))
      table.add({field.name, field.type, field.count, field.bytes.data(), field.count * sizeOf(field.type)});
    else if (&field == color.channels[0])
      addPacked(table, color);
  };
  const PointTable table = pointTable(laplacian, geometry, M, {"normal_x", "normal_y", "normal_z"}, add_field);
  OutputFile file(to);
  file.write(pcdHeader(table, geometry, conventions));
  table.write(file);
  file.close();
}

}  // namespace tufted::io
