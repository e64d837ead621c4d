#include "io/ply_header.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "io/columns.h"
#include "io/errors.h"
#include "io/field_names.h"
#include "io/line_scanner.h"
#include "io/pose.h"

namespace tufted::io {
namespace {

/// A type by the two names that it may have.
struct TypeName {
  const char *name, *other;
  FieldType type;
};
constexpr TypeName type_names[] = {{"char", "int8", FieldType::int8},        {"uchar", "uint8", FieldType::uint8},
                                   {"short", "int16", FieldType::int16},     {"ushort", "uint16", FieldType::uint16},
                                   {"int", "int32", FieldType::int32},       {"uint", "uint32", FieldType::uint32},
                                   {"float", "float32", FieldType::float32}, {"double", "float64", FieldType::float64}};

std::optional<FieldType> fieldType(std::string_view text) {
  const std::string name = lower(text);
  for (const TypeName& known : type_names)
    if (name == known.name || name == known.other) return known.type;
  return std::nullopt;
}

class PlyHeaderParser {
 public:
  PlyHeaderParser(const std::filesystem::path& path, std::string_view bytes, std::size_t size)
      : path_(path), size_(size), scanner_(path, bytes) {}

  PlyHeader parse() {
    if (!scanner_.next() || lower(scanner_.tokens()[0]) != "ply") refuseLine(path_, 1, "does not begin with 'ply'");
    while (scanner_.next()) {
      if (scanner_.isCutOff() && lower(scanner_.tokens()[0]) != "end_header")
        scanner_.refuse("the file ends within the header");
      if (keyword()) return finish();
    }
    scanner_.refuse("the header has no end_header line");
  }

 private:
  /// Parses a line. Returns true at end_header.
  bool keyword() {
    const auto& tokens = scanner_.tokens();
    const std::string word = lower(tokens[0]);
    if (word == "end_header") return true;
    if (word == "format") {
      format();
    } else if (word == "element") {
      element();
    } else if (word == "property") {
      property();
    } else if (word == "obj_info") {
      if (tokens.size() == 3 && tokens[1] == "num_cols") header_.columns = scanner_.integer(2);
      if (tokens.size() == 3 && tokens[1] == "num_rows") header_.rows = scanner_.integer(2);
      if (tokens.size() == header_.viewpoint.size() + 2 && tokens[1] == "viewpoint") {
        for (std::size_t t = 2; t < tokens.size(); ++t) header_.viewpoint[t - 2] = scanner_.number(t);
        if (const char* const fault = poseFault(header_.viewpoint)) scanner_.refuse(fault);
      }
    } else if (word != "comment") {
      scanner_.refuse("unknown keyword " + quote(tokens[0]));
    }
    return false;
  }

  void format() {
    const std::string name = scanner_.tokens().size() >= 2 ? lower(scanner_.tokens()[1]) : "";
    constexpr const char* names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    const auto known = std::find(std::begin(names), std::end(names), name);
    if (known == std::end(names))
      scanner_.refuse("the format is none of ascii, binary_little_endian, binary_big_endian");
    header_.format = static_cast<PlyHeader::Format>(known - names);
    has_format_ = true;
  }

  void element() {
    if (scanner_.tokens().size() != 3) scanner_.refuse("a name and a count expected");
    PlyElement element = {lower(scanner_.tokens()[1]), scanner_.integer(2), {}};
    if (element.count < 0 || element.count > std::numeric_limits<int>::max())
      scanner_.refuse("a count of " + quote(scanner_.tokens()[2]) + " is not in [0, 2^31)");
    header_.elements.push_back(std::move(element));
  }

  void property() {
    const auto& tokens = scanner_.tokens();
    if (header_.elements.empty()) scanner_.refuse("a property before the first element");
    const bool is_list = tokens.size() == 5 && lower(tokens[1]) == "list";
    if (!is_list && tokens.size() != 3) scanner_.refuse("a type and a name expected");
    PlyProperty property = {std::string(tokens.back()), type(is_list ? 3 : 1), is_list, FieldType::uint8};
    if (is_list) {
      property.count_type = type(2);
      if (!isInteger(property.count_type)) scanner_.refuse("the length of a list is no integer");
    }
    header_.elements.back().properties.push_back(std::move(property));
  }

  FieldType type(std::size_t token) const {
    const auto type = fieldType(scanner_.tokens()[token]);
    if (!type) scanner_.refuse("unknown type " + quote(scanner_.tokens()[token]));
    return *type;
  }

  PlyHeader finish() {
    if (!has_format_) scanner_.refuse("the header has no format line");
    header_.body = scanner_.offset();
    header_.line = scanner_.line();
    checkSize();
    return std::move(header_);
  }

  /// Checks that the file is long enough for its elements, with empty lists and, in ascii, two bytes per number.
  void checkSize() const {
    std::uint64_t least = 0;  // cannot overflow: counts are below 2^31
    for (const PlyElement& element : header_.elements) {
      std::uint64_t item = 0;
      for (const PlyProperty& property : element.properties)
        item += header_.format == PlyHeader::Format::ascii
                    ? 2
                    : sizeOf(property.is_list ? property.count_type : property.type);
      least += item * static_cast<std::uint64_t>(element.count);
    }
    if (header_.format == PlyHeader::Format::ascii && least > 0) --least;  // the last line may lack its end
    const std::size_t rest = size_ - std::min(header_.body, size_);
    if (least > rest)
      refuseByte(path_, size_,
                 "ends there; the elements of the header need at least " + std::to_string(header_.body + least));
  }

  const std::filesystem::path& path_;
  std::size_t size_;
  LineScanner scanner_;
  bool has_format_ = false;
  PlyHeader header_;
};

}  // namespace

const char* plyType(FieldType type) {
  for (const TypeName& known : type_names)
    if (known.type == type) return known.name;
  return "double";
}

PlyHeader parsePlyHeader(const std::filesystem::path& path, std::string_view bytes, std::size_t size) {
  return PlyHeaderParser(path, bytes, size).parse();
}

}  // namespace tufted::io
