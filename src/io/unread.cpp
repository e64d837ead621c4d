#include "io/unread.h"

#include "io/errors.h"

namespace tufted::io {

bool areZero(std::string_view bytes) {
  return bytes.find_first_not_of('\0') == std::string_view::npos;
}

void noteRest(const std::filesystem::path& path, const std::string& place, std::size_t bytes, bool are_zero,
              Geometry& geometry) {
  const std::string count = std::to_string(bytes) + (are_zero ? " zero" : "") + (bytes == 1 ? " byte" : " bytes");
  if (geometry.points.rows() == 0) refuse(path, place + ": " + count + " behind a header that counts no points");
  geometry.unread_bytes = static_cast<std::int64_t>(bytes);
  geometry.notes.push_back(path.string() + ": " + place + ": " + count +
                           " behind the last record that the file counts, not read");
}

void noteUnread(const std::filesystem::path& path, std::string_view bytes, std::size_t end, Geometry& geometry) {
  if (end < bytes.size())
    noteRest(path, "byte " + std::to_string(end), bytes.size() - end, areZero(bytes.substr(end)), geometry);
}

void noteUnreadLines(const std::filesystem::path& path, std::string_view text, LineScanner& scanner,
                     Geometry& geometry) {
  if (scanner.next()) noteUnreadFromHere(path, text, scanner, geometry);
}

void noteUnreadFromHere(const std::filesystem::path& path, std::string_view text, const LineScanner& scanner,
                        Geometry& geometry) {
  const auto begin = static_cast<std::size_t>(scanner.tokens().front().data() - text.data());
  noteRest(path, "line " + std::to_string(scanner.line()), text.size() - begin, areZero(text.substr(begin)), geometry);
}

}  // namespace tufted::io
