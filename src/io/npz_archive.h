#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/output_file.h"

namespace tufted::io {

/// Writes a .npz file of named arrays, a ZIP archive without compression. The same arrays give the same bytes.
class NpzArchive {
 public:
  explicit NpzArchive(const OutputPath& to) : file_(to) {}

  /// Writes an array.
  /// @param name with the ending .npy
  /// @param descr numpy's name of the type, such as "<f8"
  /// @param shape in C order; empty for a single value
  /// @param values `bytes` bytes
  /// @throws IoError if it cannot be written
  void add(const std::string& name, std::string_view descr, const std::vector<std::int64_t>& shape, const void* values,
           std::size_t bytes);
  /// Writes the directory of the archive. @throws IoError
  void close();

 private:
  OutputFile file_;
  std::uint64_t written_ = 0;  ///< size of the file so far
  std::uint64_t arrays_ = 0;
  std::string directory_;
};

}  // namespace tufted::io
