#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "io/output_file.h"

namespace tufted::io {

/// Collects small pieces of output before they are written to a file.
class OutputBuffer {
 public:
  explicit OutputBuffer(OutputFile& file);

  void append(const void* bytes, std::size_t size);
  void append(std::string_view text) { append(text.data(), text.size()); }
  void appendInteger(std::int64_t value);
  /// Appends a number with 17 significant digits, so that reading gives the same double, without trailing zeros.
  void appendNumber(double value);
  /// Writes what was collected to the file.
  void flush();

 private:
  OutputFile& file_;
  std::vector<std::byte> bytes_;
};

}  // namespace tufted::io
