#include <cstring>
#include <span>
#include <vector>

#include "io/errors.h"
#include "io/field_names.h"
#include "io/formats.h"
#include "io/line_scanner.h"
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

// Not by PCL's reader, which cannot read standard input because it takes a file name, prints to a console that all
// threads share, and needs the libraries of VTK.
// The compressed form has the compressed and the uncompressed size, then the fields one after another, without
// padding, compressed by LZF.

/// Unpacks LZF. A byte below 32 announces so many bytes and one more, which are taken as they are. Any other is the
/// beginning of a length and a distance: as many bytes are repeated from so far back.
/// @return whether the packed bytes are whole and give exactly those of `to`
bool unpackLzf(std::span<const char> from, std::span<char> to) {
  std::size_t read = 0, written = 0;
  while (read < from.size()) {
    const auto byte = [&](std::size_t at) { return static_cast<std::size_t>(static_cast<unsigned char>(from[at])); };
    const std::size_t control = byte(read++);
    if (control < 32) {
      const std::size_t count = control + 1;
      if (count > from.size() - read || count > to.size() - written) return false;
      std::memcpy(to.data() + written, from.data() + read, count);
      read += count;
      written += count;
      continue;
    }
    const bool is_long = control >> 5 == 7;
    if (from.size() - read < (is_long ? 2 : 1)) return false;
    const std::size_t count = (control >> 5) + 2 + (is_long ? byte(read++) : 0);
    const std::size_t distance = ((control & 31) << 8) + byte(read++) + 1;
    if (distance > written || count > to.size() - written) return false;
    for (std::size_t i = 0; i < count; ++i, ++written) to[written] = to[written - distance];  // they may overlap
  }
  return written == to.size();
}

/// Checks that a binary file is as long as its header says, and reads its values.
/// @return byte at which the last point ends
std::size_t readBinary(const std::filesystem::path& path, std::string_view bytes, PcdHeader& header) {
  const std::size_t rest = bytes.size() - std::min(header.body, bytes.size());
  if (static_cast<std::uint64_t>(header.points) > rest / header.row_bytes)
    refuseByte(path, bytes.size(),
               "ends there, too short for " + std::to_string(header.points) + " points of " +
                   std::to_string(header.row_bytes) + " bytes");
  allocate(header);
  const char* value = bytes.data() + header.body;
  for (std::int64_t i = 0; i < header.points; ++i) {
    for (Field& field : header.columns.fields) {
      const std::size_t size = sizeOf(field.type) * field.count;
      if (!isPadding(field)) std::memcpy(field.bytes.data() + i * size, value, size);
      value += size;
    }
  }
  return static_cast<std::size_t>(value - bytes.data());
}

// The compressed form has the compressed and the uncompressed size, then the fields one after another, without
/// padding, compressed by LZF.
std::size_t readCompressed(const std::filesystem::path& path, std::string_view bytes, PcdHeader& header) {
  const std::size_t rest = bytes.size() - std::min(header.body, bytes.size());
  std::uint32_t sizes[2];
  if (rest < sizeof(sizes)) {
    if (header.points == 0) return header.body;
    refuseByte(path, bytes.size(), "ends before the compressed data");
  }
  std::memcpy(sizes, bytes.data() + header.body, sizeof(sizes));
  if (sizes[0] > rest - sizeof(sizes))
    refuseByte(path, bytes.size(),
               "ends there; the compressed data need " + std::to_string(header.body + sizeof(sizes) + sizes[0]));
  std::uint64_t row = 0;  // bytes per point without padding
  for (const Field& field : header.columns.fields)
    if (!isPadding(field)) row += sizeOf(field.type) * field.count;
  const auto points = static_cast<std::uint64_t>(header.points);
  if (points == 0 ? sizes[1] != 0 : sizes[1] % points != 0 || sizes[1] / points != row)
    refuseByte(path, header.body + 4,
               "the compressed data hold " + std::to_string(sizes[1]) + " bytes, not those of " +
                   std::to_string(points) + " points of " + std::to_string(row) + " bytes");
  // LZF shrinks at most 264 bytes into three.
  if (static_cast<double>(sizes[1]) > 88.0 * sizes[0] + 264)
    refuseByte(path, header.body, "the compressed data are too short for what they are said to hold");

  std::vector<char> columns(sizes[1]);
  if (!unpackLzf(bytes.substr(header.body + sizeof(sizes), sizes[0]), columns))
    refuseByte(path, header.body + sizeof(sizes), "the compressed data are damaged");
  allocate(header);
  const char* column = columns.data();
  for (Field& field : header.columns.fields) {
    if (field.bytes.empty()) continue;
    std::memcpy(field.bytes.data(), column, field.bytes.size());
    column += field.bytes.size();
  }
  return header.body + sizeof(sizes) + sizes[0];
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
      end = readBinary(path, bytes, header);
      break;
    case PcdHeader::Data::binary_compressed:
      end = readCompressed(path, bytes, header);
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
