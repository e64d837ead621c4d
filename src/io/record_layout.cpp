#include <algorithm>

#include "io/errors.h"
#include "io/field_names.h"
#include "io/formats.h"
#include "io/las_header.h"
#include "io/line_scanner.h"
#include "io/npy.h"
#include "io/npy_table.h"
#include "io/pcd_header.h"
#include "io/ply_header.h"
#include "io/record_file.h"

namespace tufted::io {
namespace {

using Layout = std::optional<RecordLayout>;

Layout layoutOfLas(const std::filesystem::path& path, std::string_view bytes, std::size_t size) {
  const LasHeader header = parseLasHeader(path, bytes, size);
  RecordLayout layout = {FileFormat::las, header.points, header.record_bytes, header.body, header.end};
  layout.header = [made = std::string(bytes.substr(0, header.body)), minor = header.minor](auto points) mutable {
    put(made, las_byte::old_count, static_cast<std::uint32_t>(points));
    if (minor == 4) put<std::uint64_t>(made, las_byte::count, 0);  // 0: the other count holds
    return made;
  };
  return layout;
}

Layout layoutOfPcd(const std::filesystem::path& path, std::string_view bytes, std::size_t size) {
  PcdHeader header = parsePcdHeader(path, bytes);
  nameColumns(path, header.line, header.columns.fields);
  if (header.data != PcdHeader::Data::binary) return std::nullopt;
  LineScanner scanner(path, bytes, {.comment = '#'});
  while (scanner.next() && lower(scanner.tokens()[0]) != "data") {
  }
  const auto data = static_cast<std::size_t>(scanner.tokens()[0].data() - bytes.data());
  RecordLayout layout = {FileFormat::pcd, header.points, header.row_bytes, header.body, size};
  layout.is_organized = header.height > 1;
  layout.header = [start = std::string(bytes.substr(0, data))](auto points) {  // of repeated lines the last ones hold
    const std::string count = std::to_string(points);
    return start + "WIDTH " + count + "\nHEIGHT 1\nPOINTS " + count + "\nDATA binary\n";
  };
  return layout;
}

Layout layoutOfPly(const std::filesystem::path& path, std::string_view bytes, std::size_t size) {
  const PlyHeader header = parsePlyHeader(path, bytes, size);
  if (header.format == PlyHeader::Format::ascii || header.elements.empty() || header.elements[0].name != "vertex")
    return std::nullopt;
  const PlyElement& vertices = header.elements[0];
  columnsOf(path, header.line, vertices);
  RecordLayout layout = {FileFormat::ply, vertices.count, 0, header.body, size};
  std::string properties;
  for (const PlyProperty& property : vertices.properties) {
    if (property.is_list) return std::nullopt;
    layout.record_bytes += sizeOf(property.type);
    properties += std::string("property ") + plyType(property.type) + ' ' + property.name + '\n';
  }
  for (const PlyElement& element : header.elements) {
    if (&element == &vertices || element.count == 0) continue;
    layout.end = 0;  // elements behind the points are not read, so nothing is known of what follows them
    layout.has_faces = layout.has_faces || element.name == "face" || element.name == "tristrips";
  }
  Geometry grid;
  organize(header, vertices.count, grid);
  layout.is_organized = grid.height > 1;
  const std::string order = header.format == PlyHeader::Format::big_endian ? "big" : "little";
  layout.header = [start = "ply\nformat binary_" + order + "_endian 1.0\nelement vertex ", properties](auto points) {
    return start + std::to_string(points) + '\n' + properties + "end_header\n";
  };
  return layout;
}

Layout layoutOfNpy(const std::filesystem::path& path, std::string_view bytes, std::size_t size) {
  constexpr std::int64_t most_columns = 100;  // readNpy() refuses fewer points than values; a batch has 1,300 or more
  const NpyTable table = parseNpyTable(bytes, size, path);
  const bool is_named = !table.members.empty();
  if (!is_named && (table.columns < 3 || table.columns > most_columns)) return std::nullopt;
  if (table.height > 1 && table.row_stride != table.item_stride * static_cast<std::size_t>(table.width))
    return std::nullopt;
  RecordLayout layout = {FileFormat::npy, table.rows(), table.item_stride, npyHeaderBytes(bytes, path), size};
  if (!is_named && table.column_stride >= table.item_stride) {
    layout.record_bytes = table.value.size;
    layout.columns = table.columns;
  }
  layout.is_organized = table.width > 1 && table.height > 1;
  layout.is_named_by_values = !is_named && table.columns >= 6;
  layout.header = [start = std::string(bytes.substr(0, layout.begin)),
                   columns = is_named ? "" : "," + std::to_string(table.columns)](auto points) {
    std::string made = start, shape = std::to_string(points) + columns;
    const std::size_t begin = made.find('(', made.find("'shape':")) + 1;
    shape.resize(made.find(')', begin) - begin, ' ');  // the length of the header is part of it
    return made.replace(begin, shape.size(), shape);
  };
  return layout;
}

}  // namespace

Layout recordLayout(const std::filesystem::path& path, std::string_view bytes, std::size_t size) {
  const FileFormat format = formatOf(path, bytes);
  Layout layout;
  if (format == FileFormat::las) layout = layoutOfLas(path, bytes, size);
  if (format == FileFormat::pcd) layout = layoutOfPcd(path, bytes, size);
  if (format == FileFormat::ply) layout = layoutOfPly(path, bytes, size);
  if (format == FileFormat::npy) layout = layoutOfNpy(path, bytes, size);
  if (!layout || layout->points == 0) return std::nullopt;
  const std::size_t point_bytes = layout->record_bytes * static_cast<std::size_t>(layout->columns);
  if (static_cast<std::size_t>(layout->points) >
      (size - std::min(layout->begin, size)) / point_bytes)  // other formats have checked that
    refuseByte(path, size,
               "ends there, too short for " + std::to_string(layout->points) + " points of " +
                   std::to_string(point_bytes) + " bytes");
  return layout;
}

}  // namespace tufted::io
