#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

namespace tufted::io {

/// A regular file that is open for reading. All functions throw IoError naming the path.
class InputFile {
 public:
  /// Refuses a file that is missing, empty, not regular (a directory, a pipe), or cannot be read.
  explicit InputFile(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }
  /// Size in bytes when the file was opened.
  std::size_t size() const { return size_; }
  /// Appends bytes of the file. Refuses a file that ends before them.
  /// @param begin the first byte
  void read(std::size_t begin, std::size_t count, std::string& bytes) const;

 private:
  std::filesystem::path path_;
  std::size_t size_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

/// Reads all bytes of a file.
/// @throws IoError as InputFile
std::string readBytes(const std::filesystem::path& path);

}  // namespace tufted::io
