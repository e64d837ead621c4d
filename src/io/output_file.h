#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>

namespace tufted::io {

/// The path of a file being written.
struct OutputPath {
  std::filesystem::path path;   ///< path under which it is written
  std::filesystem::path shown;  ///< path of the finished file, to name in errors
};

/// Creates and writes a file; an existing file or link of the path is an error. Every error of the system (no space, no
/// permission) throws IoError naming the path.
class OutputFile {
 public:
  explicit OutputFile(const OutputPath& to);

  void write(const void* bytes, std::size_t size);
  void write(std::string_view text) { write(text.data(), text.size()); }
  /// Writes what is still buffered. Without this call the file may be incomplete.
  void close();

 private:
  std::filesystem::path shown_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

}  // namespace tufted::io
