#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/columns.h"
#include "io/errors.h"
#include "io/field_names.h"
#include "io/number.h"

namespace tufted::io {

/// The type that has this name in VTK.
inline std::optional<FieldType> vtkType(std::string_view text) {
  const std::string name = lower(text);
  if (name == "char" || name == "signed_char") return FieldType::int8;
  if (name == "unsigned_char") return FieldType::uint8;
  if (name == "short") return FieldType::int16;
  if (name == "unsigned_short") return FieldType::uint16;
  if (name == "int" || name == "vtkidtype") return FieldType::int32;  // vtkIdType: legacy files store 32 bits
  if (name == "unsigned_int") return FieldType::uint32;
  if (name == "long" || name == "vtktypeint64") return FieldType::int64;
  if (name == "unsigned_long" || name == "vtktypeuint64") return FieldType::uint64;
  if (name == "float") return FieldType::float32;
  if (name == "double") return FieldType::float64;
  return std::nullopt;
}

/// Reads the lines and values of a file in VTK's legacy format, text or binary.
class VtkBody {
 public:
  VtkBody(const std::filesystem::path& path, std::string_view bytes) : path_(path), bytes_(bytes) {}

  /// Moves to the next line that has a word. Returns false at the end.
  bool next() {
    offset_ = std::min(bytes_.find_first_not_of(blanks, offset_), bytes_.size());
    begin_ = offset_;
    words_.clear();
    const std::string_view text = takeLine();
    for (std::size_t at = 0; (at = std::min(text.find_first_not_of(blanks, at), text.size())) < text.size();) {
      const std::size_t end = std::min(text.find_first_of(blanks, at), text.size());
      words_.push_back(text.substr(at, end - at));
      at = end;
    }
    return !words_.empty();
  }

  /// Takes the rest of the line, which may be empty.
  std::string_view takeLine() {
    const std::size_t end = std::min(bytes_.find('\n', offset_), bytes_.size());
    const std::string_view text = bytes_.substr(offset_, end - offset_);
    offset_ = std::min(end + 1, bytes_.size());
    return text;
  }

  /// Whether an empty line or the end of the file follows, which ends METADATA.
  bool atBlankLine() const {
    const std::size_t end = bytes_.find_first_not_of(" \r", offset_);
    return end == std::string_view::npos || bytes_[end] == '\n';
  }

  std::size_t begin() const { return begin_; }  ///< byte at which the current line begins
  std::size_t words() const { return words_.size(); }
  std::string_view word(std::size_t w) const {
    if (w >= words_.size()) refuse("ends too early");
    return words_[w];
  }
  std::string keyword(std::size_t w) const { return lower(word(w)); }
  std::int64_t count(std::size_t w) const {
    std::int64_t value = 0;
    if (!parseNumber(word(w), value) || value < 0 || value > std::numeric_limits<int>::max())
      refuse(quote(word(w)) + " is not a count below 2^31");
    return value;
  }
  FieldType type(std::size_t w) const {
    const auto type = vtkType(word(w));
    if (!type) refuse("values of the unknown type " + quote(word(w)));
    return *type;
  }

  void setBinary(bool binary) { is_binary_ = binary; }
  bool isBinary() const { return is_binary_; }

  /// Reads `rows` times `count` values.
  Field values(std::string name, FieldType type, std::int64_t rows, std::int64_t count) {
    const std::size_t size = sizeOf(type), rest = bytes_.size() - offset_;
    // In text a value takes at least a digit and a blank; the last blank may be missing.
    const double least =
        static_cast<double>(rows) * static_cast<double>(count) * (is_binary_ ? static_cast<double>(size) : 2);
    if (least > static_cast<double>(rest) + (is_binary_ ? 0 : 1))
      refuse("too short for its " + std::to_string(rows) + " x " + std::to_string(count) + " values");
    Field field = {std::move(name), type, static_cast<int>(count), {}};
    field.bytes.resize(static_cast<std::size_t>(rows * count) * size);
    for (std::byte* to = field.bytes.data(); to < field.bytes.data() + field.bytes.size(); to += size) {
      if (is_binary_) {
        std::memcpy(to, bytes_.data() + offset_, size);
        if (std::endian::native == std::endian::little) std::reverse(to, to + size);
        offset_ += size;
      } else {
        takeNumber(type, to);
      }
    }
    return field;
  }

  std::vector<std::int64_t> integers(FieldType type, std::int64_t number) {
    if (!isInteger(type)) refuse("integers expected");
    const Field field = values("", type, number, 1);
    std::vector<std::int64_t> integers(static_cast<std::size_t>(number));
    for (std::size_t i = 0; i < integers.size(); ++i)
      integers[i] = static_cast<std::int64_t>(tufted::valueOf(field, i));
    return integers;
  }

  [[noreturn]] void refuse(const std::string& reason) const { refuseByte(path_, begin_, reason); }

 private:
  static constexpr std::string_view blanks = " \t\r\n\f\v";

  void takeNumber(FieldType type, std::byte* to) {
    offset_ = std::min(bytes_.find_first_not_of(blanks, offset_), bytes_.size());
    const std::size_t end = std::min(bytes_.find_first_of(blanks, offset_), bytes_.size());
    const std::string_view token = bytes_.substr(offset_, end - offset_);
    if (!parseInto(token, type, to)) refuseByte(path_, offset_, quote(token) + " is not a number of its type");
    offset_ = end;
  }

  const std::filesystem::path& path_;
  std::string_view bytes_;
  std::size_t offset_ = 0, begin_ = 0;
  std::vector<std::string_view> words_;
  bool is_binary_ = false;
};

}  // namespace tufted::io
