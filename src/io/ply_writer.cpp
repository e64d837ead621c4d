#include <cstring>
#include <string>

#include "io/columns.h"
#include "io/output_file.h"
#include "io/ply_header.h"
#include "io/point_table.h"
#include "io/point_writers.h"

namespace tufted::io {
namespace {

const std::byte* toDouble(PointTable& table, const Field& field) {
  const std::size_t values = table.rows() * field.count;
  std::byte* const made = table.allocate(values * sizeof(double));
  for (std::size_t i = 0; i < values; ++i) {
    const double value = valueOf(field.type, field.bytes.data() + i * sizeOf(field.type));
    std::memcpy(made + i * sizeof(double), &value, sizeof(double));
  }
  return made;
}

void addField(PointTable& table, const Field& field) {
  if (addPackedColor(table, field)) return;
  const bool wide = field.type == FieldType::int64 || field.type == FieldType::uint64;
  const FieldType type = wide ? FieldType::float64 : field.type;
  const std::byte* const first = wide ? toDouble(table, field) : field.bytes.data();
  for (int c = 0; c < field.count; ++c)
    table.add({field.count == 1 ? field.name : field.name + "_" + std::to_string(c), type, 1, first + c * sizeOf(type),
               field.count * sizeOf(type)});
}

std::string plyHeader(const PointTable& table, const Geometry& geometry, const std::vector<Convention>& conventions) {
  std::string text = "ply\nformat binary_little_endian 1.0\n";
  text += conventionLines(conventions, "comment tufted ", true);
  // In obj_info, because floats in PCL's element `camera` would round the pose of a georeferenced scan.
  if (geometry.viewpoint != Geometry().viewpoint) text += "obj_info viewpoint " + viewpointText(geometry) + "\n";
  if (geometry.height > 1) {
    text += "obj_info num_cols " + std::to_string(geometry.width) + "\n";
    text += "obj_info num_rows " + std::to_string(geometry.height) + "\n";
  }
  text += "element vertex " + std::to_string(table.rows()) + "\n";
  for (const PointColumn& column : table.columns())
    text += "property " + std::string(plyType(column.type)) + " " + column.name + "\n";
  if (geometry.is_mesh)
    text += "element face " + std::to_string(geometry.triangles.rows()) + "\nproperty list uchar int vertex_indices\n";
  return text + "end_header\n";
}

}  // namespace

void writePly(const OutputPath& to, const Laplacian& laplacian, const Geometry& geometry, const VectorXd& M,
              const std::vector<Convention>& conventions) {
  const PointTable table = pointTable(laplacian, geometry, M, {"nx", "ny", "nz"}, addField);
  OutputFile file(to);
  file.write(plyHeader(table, geometry, conventions));
  table.write(file);
  if (geometry.is_mesh) {
    const std::uint8_t corners = 3;
    for (Eigen::Index f = 0; f < geometry.triangles.rows(); ++f) {
      file.write(&corners, 1);
      file.write(geometry.triangles.data() + 3 * f, 3 * sizeof(int));
    }
  }
  file.close();
}

}  // namespace tufted::io
