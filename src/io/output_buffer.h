#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "io/output_file.h"

namespace tufted::io {

/// Gathers small pieces before they go to a file.
class OutputBuffer {
 public:
  explicit OutputBuffer(OutputFile& file);

  void append(const void* bytes, std::size_t size);
  void append(std::string_view text) { append(text.data(), text.size()); }
  void appendInteger(std::int64_t value);
  /// Adds a number with 17 significant digits, enough to read the same double again, without trailing zeros.
  void appendNumber(double value);
  /// Passes everything on to the file.
  void flush();

 private:
  OutputFile& file_;
  std::vector<std::byte> bytes_;
};

}  // namespace tufted::io
