#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "io/columns.h"
#include "io/errors.h"
#include "io/field_names.h"
#include "io/formats.h"
#include "io/ply_body.h"
#include "io/ply_header.h"
#include "io/polygon_soup.h"

// Not by PCL or CGAL. Of 24 pairs of list types (4 of the length, 6 of the corners) PCL 1.13 silently returns empty
// faces for 10, and it packs colours into a float. CGAL 5.5 refuses 16, crashes on integer coordinates and drops all
// other properties.
namespace tufted::io {
namespace {

/// Reads one value per vertex and property. Lists are skipped, because a Field cannot hold them.
Columns readVertices(const std::filesystem::path& path, std::int64_t header_lines, const PlyElement& element,
                     PlyBody& body) {
  Columns columns = columnsOf(path, header_lines, element);
  allocate(columns, element.count);
  for (std::int64_t i = 0; i < element.count; ++i) {
    body.beginItem(element);
    std::size_t field = 0;
    for (const PlyProperty& property : element.properties) {
      if (property.is_list)
        body.skip(property);
      else
        body.value(property.type, columns.fields[field++].bytes.data() + i * sizeOf(property.type));
    }
    body.endItem();
  }
  return columns;
}

void readFaces(const PlyElement& element, bool strips, PlyBody& body, PolygonSoup& soup) {
  const auto corners =
      std::find_if(element.properties.begin(), element.properties.end(), [](const PlyProperty& property) {
        return property.is_list && isInteger(property.type) &&
               isOneOf(lower(property.name), {"vertex_indices", "vertex_index", "vertex_indexes"});
      });
  if (corners == element.properties.end())
    body.refuse("the element " + quote(element.name) + " has no list of integers 'vertex_indices'");
  soup.place_name = body.placeName();
  if (!strips) soup.reserve(element.count);
  for (std::int64_t f = 0; f < element.count; ++f) {
    body.beginItem(element);
    std::vector<int> polygon;
    for (auto property = element.properties.begin(); property != element.properties.end(); ++property) {
      if (property != corners) {
        body.skip(*property);
        continue;
      }
      polygon.resize(body.listLength(*property));
      for (int& corner : polygon) {
        const std::int64_t vertex = body.integer(property->type);
        if (vertex != static_cast<int>(vertex)) body.refuse("no vertex " + std::to_string(vertex));
        corner = static_cast<int>(vertex);
      }
    }
    body.endItem();
    if (strips)
      soup.addStrip(polygon, body.place());
    else
      soup.add(std::move(polygon), body.place());
  }
}

/// Reads the pose of the sensor from the element `camera` of PCL's writer: floats with the origin and the rows of the
/// rotation. A matrix that is no rotation is ignored.
void readCamera(const PlyElement& element, PlyBody& body, std::array<double, 7>& viewpoint) {
  constexpr std::array names = {"view_px", "view_py", "view_pz", "x_axisx", "x_axisy", "x_axisz",
                                "y_axisx", "y_axisy", "y_axisz", "z_axisx", "z_axisy", "z_axisz"};
  std::array<double, names.size()> values = {};
  body.beginItem(element);
  for (const PlyProperty& property : element.properties) {
    const auto name = std::find(names.begin(), names.end(), lower(property.name));
    if (property.is_list || name == names.end()) {
      body.skip(property);
      continue;
    }
    std::byte bytes[sizeof(double)];
    body.value(property.type, bytes);
    values[name - names.begin()] = valueOf(property.type, bytes);
    if (!std::isfinite(values[name - names.begin()])) body.refuse("a viewpoint that is not finite");
  }
  body.endItem();
  using Matrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  const Matrix rotation = Eigen::Map<const Matrix>(values.data() + 3);
  if (!((rotation * rotation.transpose()).isIdentity(1e-3) && rotation.determinant() > 0)) return;
  const Eigen::Quaterniond orientation = Eigen::Quaterniond(rotation).normalized();
  viewpoint = {values[0], values[1], values[2], orientation.w(), orientation.x(), orientation.y(), orientation.z()};
}

void skipElement(const PlyElement& element, PlyBody& body) {
  if (element.properties.empty()) return;
  for (std::int64_t i = 0; i < element.count; ++i) {
    body.beginItem(element);
    for (const PlyProperty& property : element.properties) body.skip(property);
    body.endItem();
  }
}

}  // namespace

Columns columnsOf(const std::filesystem::path& path, std::int64_t header_lines, const PlyElement& vertices) {
  Columns columns;
  for (const PlyProperty& property : vertices.properties)
    if (!property.is_list) columns.fields.push_back({property.name, property.type, 1, {}});
  nameColumns(path, header_lines, columns.fields);
  return columns;
}

std::string formatName(const PlyHeader& header) {
  constexpr const char* names[] = {"PLY, ascii", "PLY, binary little endian", "PLY, binary big endian"};
  return names[static_cast<int>(header.format)];
}

void organize(const PlyHeader& header, std::int64_t points, Geometry& geometry) {
  constexpr std::int64_t most = std::numeric_limits<int>::max();
  if (header.columns <= 0 || header.rows <= 0 || header.columns > most || header.rows > most) return;
  if (header.columns * header.rows != points) return;
  geometry.width = static_cast<int>(header.columns);
  geometry.height = static_cast<int>(header.rows);
}

Geometry readPly(const std::filesystem::path& path, std::string_view bytes, bool with_faces, const Progress& progress) {
  const PlyHeader header = parsePlyHeader(path, bytes, bytes.size());
  const auto body = makePlyBody(path, bytes, header);
  Columns columns;
  PolygonSoup soup;
  bool has_vertices = false;
  auto viewpoint = header.viewpoint;
  for (const PlyElement& element : header.elements) {
    const bool strips = element.name == "tristrips";
    if (element.name == "vertex" && !has_vertices) {
      columns = readVertices(path, header.line, element, *body);
      has_vertices = true;
    } else if (with_faces && element.count > 0 && (element.name == "face" || strips)) {
      readFaces(element, strips, *body, soup);
    } else if (element.name == "camera" && element.count == 1) {
      readCamera(element, *body, viewpoint);
    } else {
      skipElement(element, *body);
    }
  }
  if (!has_vertices) refuseLine(path, header.line, "has no element 'vertex'");
  Geometry geometry = toGeometry(std::move(columns));
  body->end(geometry);
  geometry.viewpoint = viewpoint;
  geometry.format = formatName(header);
  organize(header, geometry.points.rows(), geometry);
  setPolygons(path, soup, progress, geometry);
  return geometry;
}

}  // namespace tufted::io
