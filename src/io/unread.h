#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "io/line_scanner.h"
#include "tufted/io/read.h"

namespace tufted::io {

/// Notes in Geometry::notes that bytes after the last record are skipped, if there are any.
/// @param bytes the whole file
/// @param end byte at which the last record ends
/// @param geometry the records that were read
/// @throws IoError naming the byte if there are bytes but no record, because such a file must not be read as empty
void noteUnread(const std::filesystem::path& path, std::string_view bytes, std::size_t end, Geometry& geometry);

/// Whether all bytes are 0, as those with which PCL's writer pads files.
bool areZero(std::string_view bytes);

/// noteUnread() for a file that is not in memory.
/// @param place where the bytes after the last record begin: "byte 120"
void noteRest(const std::filesystem::path& path, const std::string& place, std::size_t bytes, bool are_zero,
              Geometry& geometry);

/// noteUnread() for a text whose last record is in the scanner's current line. Blank lines and comments do not count.
/// @throws IoError naming the line
void noteUnreadLines(const std::filesystem::path& path, std::string_view text, LineScanner& scanner,
                     Geometry& geometry);

/// noteUnread() for a text whose last record is before the scanner's current line.
/// @throws IoError naming the line
void noteUnreadFromHere(const std::filesystem::path& path, std::string_view text, const LineScanner& scanner,
                        Geometry& geometry);

}  // namespace tufted::io
