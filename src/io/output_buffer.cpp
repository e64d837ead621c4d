#include "io/output_buffer.h"

#include <charconv>
#include <limits>

namespace tufted::io {
namespace {

/// Bytes that are collected before they are written.
constexpr std::size_t capacity = 1 << 20;
/// Upper bound of the characters of a number with 17 digits.
constexpr std::size_t longest_number = 32;

}  // namespace

OutputBuffer::OutputBuffer(OutputFile& file) : file_(file) {
  bytes_.reserve(capacity + longest_number);
}

void OutputBuffer::append(const void* bytes, std::size_t size) {
  const auto* begin = static_cast<const std::byte*>(bytes);
  bytes_.insert(bytes_.end(), begin, begin + size);
  if (bytes_.size() >= capacity) flush();
}

void OutputBuffer::appendInteger(std::int64_t value) {
  char text[longest_number];
  append(text, std::to_chars(text, text + longest_number, value).ptr - text);
}

void OutputBuffer::appendNumber(double value) {
  char text[longest_number];
  constexpr int digits = std::numeric_limits<double>::max_digits10;
  append(text, std::to_chars(text, text + longest_number, value, std::chars_format::general, digits).ptr - text);
}

void OutputBuffer::flush() {
  file_.write(bytes_.data(), bytes_.size());
  bytes_.clear();
}

}  // namespace tufted::io
