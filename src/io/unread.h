#pragma once

#include <filesystem>
#include <string_view>

#include "io/line_scanner.h"
#include "tufted/io/read.h"

namespace tufted::io {

/// Notes the bytes behind the last record that a file counts, which are passed over. Behind no record at all they are
/// refused, as a file that holds something must not be read as an empty one.
/// @param geometry what was read of the records
/// @param end where the last record ends; nothing is noted if that is the end of the file
/// @throws IoError naming the byte
void noteUnread(const std::filesystem::path& path, std::string_view bytes, std::size_t end, Geometry& geometry);

/// The same for a text whose last record is in the scanner's current line; blank lines and comments are no content.
/// @throws IoError naming the line
void noteUnreadLines(const std::filesystem::path& path, std::string_view text, LineScanner& scanner,
                     Geometry& geometry);

/// The same for a text whose records end before the scanner's current line.
void noteUnreadFromHere(const std::filesystem::path& path, std::string_view text, const LineScanner& scanner,
                        Geometry& geometry);

}  // namespace tufted::io
