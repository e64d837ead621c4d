#include <cstring>

#include "io/errors.h"
#include "io/field_names.h"
#include "io/formats.h"
#include "io/line_scanner.h"
#include "io/pcd_binary.h"
#include "io/pcd_header.h"
#include "io/unread.h"

namespace tufted::io {
namespace {

/// Reads one point per line. Not by PCL, which accepts `a b c` as numbers, and lines that are too short.
void readAscii(const std::filesystem::path& path, std::string_view text, LineScanner& scanner, PcdHeader& header) {
  // A value takes at least two bytes, a digit and a separator, but for the last.
  const std::size_t rest = text.size() - std::min(header.body, text.size());
  if (static_cast<double>(header.points) * static_cast<double>(header.row_values) * 2 > static_cast<double>(rest) + 1)
    refuseByte(path, text.size(), "too short for the " + std::to_string(header.points) + " points of its header");
  allocate(header);
  scanner.seek(header.body, header.line);
  for (std::int64_t i = 0; i < header.points; ++i) {
    if (!scanner.next())
      refuseLine(path, scanner.line(),
                 "ends after " + std::to_string(i) + " of " + std::to_string(header.points) + " points");
    if (static_cast<std::int64_t>(scanner.tokens().size()) != header.row_values)
      scanner.refuse(std::to_string(scanner.tokens().size()) + " values where " + std::to_string(header.row_values) +
                     " are expected");
    std::size_t token = 0;
    for (Field& field : header.columns.fields) {
      const std::size_t size = sizeOf(field.type);
      for (int c = 0; c < field.count; ++c, ++token) {
        std::byte padding[sizeof(double)];
        std::byte* const value = isPadding(field) ? padding : field.bytes.data() + (i * field.count + c) * size;
        if (!parseInto(scanner.tokens()[token], field.type, value))
          scanner.refuse(quote(scanner.tokens()[token]) + " is not a number for the field " + quote(field.name));
      }
    }
  }
}

}  // namespace

bool looksLikePcd(std::string_view bytes) {
  const auto tokens = firstTokens(bytes, {.comment = '#'});
  return !tokens.empty() && isOneOf(lower(tokens[0]), {"version", "fields", "columns"});
}

std::string formatName(const PcdHeader& header) {
  constexpr const char* names[] = {"PCD, ascii", "PCD, binary", "PCD, binary_compressed"};
  return names[static_cast<int>(header.data)];
}

Geometry readPcd(const std::filesystem::path& path, std::string_view bytes) {
  PcdHeader header = parsePcdHeader(path, bytes);
  nameColumns(path, header.line, header.columns.fields);
  LineScanner scanner(path, bytes, {.comment = '#'});
  std::size_t end = bytes.size();
  switch (header.data) {
    case PcdHeader::Data::ascii:
      readAscii(path, bytes, scanner, header);
      break;
    case PcdHeader::Data::binary:
      end = readPcdBinary(path, bytes, header);
      break;
    case PcdHeader::Data::binary_compressed:
      end = readPcdCompressed(path, bytes, header);
      break;
  }
  Geometry geometry = toGeometry(std::move(header.columns));
  if (header.data == PcdHeader::Data::ascii)
    noteUnreadLines(path, bytes, scanner, geometry);
  else
    noteUnread(path, bytes, end, geometry);
  geometry.format = formatName(header);
  geometry.width = static_cast<int>(header.width);
  geometry.height = static_cast<int>(header.height);
  geometry.viewpoint = header.viewpoint;
  return geometry;
}

}  // namespace tufted::io
