#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "io/line_scanner.h"
#include "tufted/io/read.h"

namespace tufted::io {

/// The note that bytes after the last record are skipped.
/// @param place where they begin: "byte 120"
/// @param are_zero whether all of them are 0
std::string unreadNote(const std::filesystem::path& path, const std::string& place, std::size_t count, bool are_zero);

/// Notes in Geometry::notes that bytes after the last record are skipped, if there are any.
/// @param bytes the whole file
/// @param end byte at which the last record ends
/// @param geometry the records that were read
/// @throws IoError naming the byte if there are bytes but no record, because such a file must not be read as empty
void noteUnread(const std::filesystem::path& path, std::string_view bytes, std::size_t end, Geometry& geometry);

/// noteUnread() for a text whose last record is in the scanner's current line. Blank lines and comments do not count.
/// @throws IoError naming the line
void noteUnreadLines(const std::filesystem::path& path, std::string_view text, LineScanner& scanner,
                     Geometry& geometry);

/// noteUnread() for a text whose last record is before the scanner's current line.
/// @throws IoError naming the line
void noteUnreadFromHere(const std::filesystem::path& path, std::string_view text, const LineScanner& scanner,
                        Geometry& geometry);

}  // namespace tufted::io
