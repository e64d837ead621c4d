#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace tufted::io {

/// Reads all bytes of a file.
/// @throws IoError if it is missing, empty, not a regular file (a directory, a pipe), or cannot be read
std::string readBytes(const std::filesystem::path& path);

/// The bytes of a regular file, which the system reads from disk where they are looked at. Only a fourth of them, a
/// sixteenth, ... if the process may not have more addresses (`ulimit -v`), which is enough for a header; none if the
/// file cannot be opened.
class MappedFile {
 public:
  explicit MappedFile(const std::filesystem::path& path);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::string_view bytes() const { return bytes_; }
  /// Bytes of the file.
  std::size_t size() const { return size_; }

 private:
  std::string_view bytes_;
  std::size_t size_ = 0;
};

}  // namespace tufted::io
