#include "io/record_layout.h"

#include "io/field_names.h"
#include "io/formats.h"
#include "io/las_header.h"
#include "io/line_scanner.h"
#include "io/npy.h"
#include "io/npy_table.h"
#include "io/pcd_binary.h"
#include "io/ply_header.h"
#include "io/ply_writer.h"

namespace tufted::io {
namespace {

using Layout = std::optional<RecordLayout>;

Layout layoutOfLas(const std::filesystem::path& path, std::string_view bytes, std::size_t all) {
  const LasHeader header = parseLasHeader(path, bytes, all);
  RecordLayout layout = {FileFormat::las, header.points, header.record_bytes};
  layout.begin = header.body;
  layout.end = header.end;
  layout.header = [start = std::string(bytes.substr(0, header.body)), has_long_count = header.minor == 4](auto points) {
    std::string made = start;
    put(made, las_byte::old_count, static_cast<std::uint32_t>(points));
    if (has_long_count) put<std::uint64_t>(made, las_byte::count, 0);  // 0: the other count holds
    return made;
  };
  return layout;
}

Layout layoutOfPcd(const std::filesystem::path& path, std::string_view bytes, std::size_t all) {
  PcdHeader header = parsePcdHeader(path, bytes);
  nameColumns(path, header.line, header.columns.fields);
  if (header.data != PcdHeader::Data::binary) return std::nullopt;
  checkPcdSize(path, header, all);
  LineScanner scanner(path, bytes, {.comment = '#'});
  while (scanner.next() && lower(scanner.tokens()[0]) != "data") {
  }
  const std::string_view start = bytes.substr(0, static_cast<std::size_t>(scanner.tokens()[0].data() - bytes.data()));
  RecordLayout layout = {FileFormat::pcd, header.points, header.row_bytes};
  layout.begin = header.body;
  layout.end = all;
  layout.is_organized = header.height > 1;
  layout.header = [start = std::string(start)](auto points) {  // of repeated lines the last ones hold
    const std::string count = std::to_string(points);
    return start + "WIDTH " + count + "\nHEIGHT 1\nPOINTS " + count + "\nDATA binary\n";
  };
  return layout;
}

Layout layoutOfPly(const std::filesystem::path& path, std::string_view bytes, std::size_t all) {
  const PlyHeader header = parsePlyHeader(path, bytes, all);
  if (header.format == PlyHeader::Format::ascii || header.elements.empty() || header.elements[0].name != "vertex")
    return std::nullopt;
  const PlyElement& vertices = header.elements[0];
  columnsOf(path, header.line, vertices);
  RecordLayout layout = {FileFormat::ply, vertices.count};
  layout.begin = header.body;
  layout.end = all;
  std::string properties;
  for (const PlyProperty& property : vertices.properties) {
    if (property.is_list) return std::nullopt;
    layout.record_bytes += sizeOf(property.type);
    properties += std::string("property ") + plyType(property.type) + ' ' + property.name + '\n';
  }
  for (std::size_t e = 1; e < header.elements.size(); ++e) {
    const PlyElement& element = header.elements[e];
    if (element.count == 0) continue;
    layout.end = 0;  // lists are not read, so nothing is known of what follows them
    layout.has_faces = layout.has_faces || element.name == "face" || element.name == "tristrips";
  }
  Geometry grid;
  organize(header, vertices.count, grid);
  layout.is_organized = grid.height > 1;
  const char* const order = header.format == PlyHeader::Format::big_endian ? "big" : "little";
  layout.header = [order, properties](auto points) {
    return std::string("ply\nformat binary_") + order + "_endian 1.0\nelement vertex " + std::to_string(points) + '\n' +
           properties + "end_header\n";
  };
  return layout;
}

Layout layoutOfNpy(const std::filesystem::path& path, std::string_view bytes, std::size_t all) {
  constexpr std::int64_t most_columns = 100;  // readNpy() refuses fewer points than values; a batch has 1,300 or more
  const NpyTable table = parseNpyTable(bytes, all, path);
  const bool is_named = !table.members.empty();
  if (!is_named && (table.columns < 3 || table.columns > most_columns)) return std::nullopt;
  if (table.height > 1 && table.row_stride != table.item_stride * static_cast<std::size_t>(table.width))
    return std::nullopt;
  RecordLayout layout = {FileFormat::npy, table.rows(), table.item_stride};
  if (!is_named && table.column_stride >= table.item_stride) {
    layout.record_bytes = table.value.size;
    layout.columns = table.columns;
  }
  layout.begin = npyHeaderBytes(bytes, path);
  layout.end = all;
  layout.is_organized = table.width > 1 && table.height > 1;
  layout.is_named_by_values = !is_named && table.columns >= 6;
  layout.header = [start = std::string(bytes.substr(0, layout.begin)),
                   columns = is_named ? "" : "," + std::to_string(table.columns)](auto points) {
    std::string made = start;
    const std::size_t shape = made.find('(', made.find("'shape':")) + 1;
    std::string shorter = std::to_string(points) + columns;
    shorter.resize(made.find(')', shape) - shape, ' ');  // the length of the header is part of it
    return made.replace(shape, shorter.size(), shorter);
  };
  return layout;
}

Layout layoutOf(const std::filesystem::path& path, std::string_view bytes, std::size_t all) {
  switch (guessFormat(path, bytes)) {
    case FileFormat::las:
      return layoutOfLas(path, bytes, all);
    case FileFormat::pcd:
      return layoutOfPcd(path, bytes, all);
    case FileFormat::ply:
      return layoutOfPly(path, bytes, all);
    case FileFormat::npy:
      return layoutOfNpy(path, bytes, all);
    default:
      return std::nullopt;
  }
}

}  // namespace

Layout recordLayout(const std::filesystem::path& path, std::string_view bytes, std::size_t all) {
  Layout layout = layoutOf(path, bytes, all);
  if (!layout || layout->points == 0) return std::nullopt;
  layout->rest = layout->begin + static_cast<std::size_t>(layout->points * layout->columns) * layout->record_bytes;
  return layout;
}

}  // namespace tufted::io
