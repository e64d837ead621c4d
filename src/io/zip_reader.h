#pragma once

#include <zlib.h>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace tufted::io {

/// In a ZIP archive, a field of four bytes with this value says that its number has a field of eight bytes (Zip64).
constexpr std::uint64_t zip64_field = 0xffffffff;

/// A file in a ZIP archive, as the directory of the archive describes it.
struct ZipEntry {
  std::string_view packed;
  std::uint64_t size = 0;  ///< bytes when unpacked
  std::uint32_t checksum = 0;
  bool is_deflated = false;
  bool is_readable = true;  ///< not encrypted, and stored or deflated
};

/// The files in an archive by their names.
/// @param bytes the whole archive; must outlive the result
/// @return nullopt for anything else than an archive, a damaged directory, or two files with one name
std::optional<std::map<std::string, ZipEntry, std::less<>>> readZipDirectory(std::string_view bytes);

/// Unpacks a file piece by piece.
class ZipStream {
 public:
  /// @param entry that is readable
  explicit ZipStream(const ZipEntry& entry);

  /// Unpacks the next bytes, and compares the checksum after the last of the file.
  /// @return false if the file is damaged or shorter
  bool read(char* to, std::size_t bytes);

 private:
  struct End {
    void operator()(z_stream* stream) const;
  };

  ZipEntry entry_;
  std::uint64_t taken_ = 0;
  uLong checksum_ = 0;
  std::unique_ptr<z_stream, End> stream_;  ///< null for a file that is not deflated
};

}  // namespace tufted::io
