#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

namespace tufted::io {

/// The path of a file being written.
struct OutputPath {
  std::filesystem::path path;   ///< path under which it is written
  std::filesystem::path shown;  ///< path of the finished file, to name in errors
};

/// Creates and writes a file; an existing file or link of the path is an error. Every error of the system (no space, no
/// permission) throws IoError naming the path. Small pieces are collected before they are written.
class OutputFile {
 public:
  explicit OutputFile(const OutputPath& to);

  void write(const void* bytes, std::size_t size);
  void write(std::string_view text) { write(text.data(), text.size()); }
  void writeInteger(std::int64_t value);
  /// Writes a number with 17 significant digits, so that reading gives the same double, without trailing zeros.
  void writeNumber(double value);
  /// Writes what is still collected. Without this call the file may be incomplete.
  void close();

 private:
  void flush();

  std::filesystem::path shown_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  std::vector<std::byte> collected_;
};

/// Writes a file of this text. @throws IoError
void writeText(const OutputPath& to, std::string_view text);

}  // namespace tufted::io
