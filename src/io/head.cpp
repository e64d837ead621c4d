#include "tufted/io/head.h"

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "io/errors.h"
#include "io/file_text.h"
#include "io/formats.h"
#include "io/las_header.h"
#include "io/pcd_header.h"
#include "io/ply_header.h"

namespace tufted {
namespace {

bool hasNormals(const std::vector<Field>& fields) {
  int found = 0;
  for (const Field& field : fields)
    if (field.count == 1 && (field.name == "nx" || field.name == "ny" || field.name == "nz")) ++found;
  return found == 3;
}

/// Makes the geometry of columns without values.
FileHead headOf(io::Columns&& columns, std::int64_t points) {
  FileHead head;
  head.has_normals = hasNormals(columns.fields);
  head.points = points;
  head.geometry = io::toGeometry(std::move(columns));
  head.geometry.width = static_cast<int>(points);
  return head;
}

FileHead headOfPcd(const std::filesystem::path& path, std::string_view bytes) {
  io::PcdHeader header = io::parsePcdHeader(path, bytes);
  io::nameColumns(path, header.line, header.columns.fields);
  FileHead head = headOf(std::move(header.columns), header.points);
  head.geometry.format = io::formatName(header);
  head.geometry.width = static_cast<int>(header.width);
  head.geometry.height = static_cast<int>(header.height);
  head.geometry.viewpoint = header.viewpoint;
  return head;
}

FileHead headOfPly(const std::filesystem::path& path, std::string_view bytes, std::size_t size) {
  const io::PlyHeader header = io::parsePlyHeader(path, bytes, size);
  const auto element = [&](const char* name) {
    return std::find_if(header.elements.begin(), header.elements.end(),
                        [name](const io::PlyElement& each) { return each.name == name; });
  };
  const auto vertices = element("vertex"), faces = element("face"), strips = element("tristrips");
  if (vertices == header.elements.end()) io::refuseLine(path, header.line, "has no element 'vertex'");
  FileHead head = headOf(io::columnsOf(path, header.line, *vertices), vertices->count);
  for (const auto& each : {faces, strips})
    if (each != header.elements.end()) head.faces += each->count;
  head.geometry.format = io::formatName(header);
  head.geometry.viewpoint = header.viewpoint;
  io::organize(header, head.points, head.geometry);
  return head;
}

FileHead headOfLas(const std::filesystem::path& path, std::string_view bytes, std::size_t size) {
  const io::LasHeader header = io::parseLasHeader(path, bytes, size);
  FileHead head = {.geometry = io::lasWithoutPoints(header), .points = header.points};
  head.geometry.width = static_cast<int>(io::checkedRows(path, header.points));
  return head;
}

}  // namespace

std::optional<FileHead> readHead(const std::filesystem::path& path, ReadAs as) {
  const io::MappedFile file(path);
  if (file.bytes().empty()) return std::nullopt;
  FileHead head;
  switch (io::formatOf(path, file.bytes())) {
    case FileFormat::pcd:
      head = headOfPcd(path, file.bytes());
      break;
    case FileFormat::ply:
      head = headOfPly(path, file.bytes(), file.size());
      break;
    case FileFormat::las:
      head = headOfLas(path, file.bytes(), file.size());
      break;
    default:
      return std::nullopt;
  }
  if (as == ReadAs::cloud) head.faces = 0;
  head.geometry.is_mesh = head.faces > 0;
  return head;
}

}  // namespace tufted
