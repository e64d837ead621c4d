#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>

namespace tufted::io {

/// Where a file goes.
struct OutputPath {
  std::filesystem::path path;   ///< where the bytes go
  std::filesystem::path shown;  ///< the path to name in errors, that of the finished file
};

/// A new file being written; there must be no file or link of its path. Every error of the system (no space, no
/// permission) throws IoError naming the path.
class OutputFile {
 public:
  explicit OutputFile(const OutputPath& to);

  void write(const void* bytes, std::size_t size);
  void write(std::string_view text) { write(text.data(), text.size()); }
  /// Writes what is still buffered. A file that is not closed may be incomplete.
  void close();

 private:
  std::filesystem::path shown_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

}  // namespace tufted::io
