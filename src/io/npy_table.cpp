#include "io/npy_table.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstring>
#include <optional>

#include "io/errors.h"
#include "io/field_names.h"
#include "io/npy.h"
#include "io/number.h"

namespace tufted::io {
namespace {

constexpr const char* remedy = "; in Python: numpy.save(file, array.astype(float))";

/// A Python literal of strings, integers, tuples and lists: 'a', 3, (...), [...].
struct Literal {
  std::string_view text;  ///< content of a string, or digits of an integer
  bool is_string = false;
  std::vector<Literal> items;
};

class LiteralParser {
 public:
  explicit LiteralParser(std::string_view text) : rest_(text) {}

  std::optional<Literal> parse(int depth = 0) {
    skipBlanks();
    if (rest_.empty() || depth > most_depth) return std::nullopt;
    const char first = rest_.front();
    if (first == '(' || first == '[') return parseItems(first == '(' ? ')' : ']', depth);
    if (first == '\'' || first == '"') {
      const std::size_t end = rest_.find(first, 1);
      if (end == std::string_view::npos) return std::nullopt;
      Literal literal = {rest_.substr(1, end - 1), true, {}};
      rest_.remove_prefix(end + 1);
      return literal;
    }
    const std::size_t end = std::min(rest_.find_first_not_of("0123456789"), rest_.size());
    Literal literal = {rest_.substr(0, end), false, {}};
    rest_.remove_prefix(end);
    return end == 0 ? std::nullopt : std::optional(literal);
  }

 private:
  static constexpr int most_depth = 4;  // one more than a list of members with a title and a shape has

  void skipBlanks() { rest_.remove_prefix(std::min(rest_.find_first_not_of(' '), rest_.size())); }

  std::optional<Literal> parseItems(char end, int depth) {
    Literal literal;
    rest_.remove_prefix(1);
    for (;;) {
      skipBlanks();
      if (rest_.starts_with(end)) break;
      std::optional<Literal> item = parse(depth + 1);
      if (!item) return std::nullopt;
      literal.items.push_back(std::move(*item));
      skipBlanks();
      if (rest_.starts_with(','))
        rest_.remove_prefix(1);
      else if (!rest_.starts_with(end))
        return std::nullopt;
    }
    rest_.remove_prefix(1);
    return literal;
  }

  std::string_view rest_;
};

/// Parses numpy's name of a real type, such as '<f4', '>i2' or '|b1'. The caller sets name and offset.
std::optional<NpyColumn> realType(std::string_view text) {
  if (text.size() < 3 || std::string_view("<>|=").find(text[0]) == std::string_view::npos) return std::nullopt;
  NpyColumn column = {"", FieldType::float64, text[1], 0, text[0] == '>', 0};
  if (!parseNumber(text.substr(2), column.size)) return std::nullopt;
  const std::string_view name = text.substr(1);
  const std::optional<FieldType> type = name == "f2"   ? FieldType::float32
                                        : name == "b1" ? FieldType::uint8
                                                       : typeOf(column.kind, column.size);
  if (!type) return std::nullopt;
  column.type = *type;
  return column;
}

/// Converts a half-precision number (IEEE 754 binary16).
float fromHalf(std::uint16_t half) {
  const int exponent = half >> 10 & 31, fraction = half & 1023;
  const float magnitude = exponent == 31  ? (fraction == 0 ? INFINITY : NAN)
                          : exponent == 0 ? std::ldexp(static_cast<float>(fraction), -24)
                                          : std::ldexp(static_cast<float>(1024 + fraction), exponent - 25);
  return (half & 0x8000) != 0 ? -magnitude : magnitude;
}

class TableParser {
 public:
  TableParser(std::string_view bytes, std::size_t size, const std::filesystem::path& shown, bool is_flat)
      : bytes_(bytes), size_(size), shown_(shown), is_flat_(is_flat), layout_(parseNpyLayout(bytes, shown)) {}

  NpyTable parse() {
    readType();
    table_.values = bytes_.data() + layout_.bytes;
    std::uint64_t values = 1;  // the product of the shape is at most 2^48
    for (const std::int64_t length : layout_.shape) values *= static_cast<std::uint64_t>(length);
    const std::size_t given = size_ - layout_.bytes;
    if (item_bytes_ > 0 && values > given / item_bytes_)
      refuse("has " + std::to_string(given) + " bytes of values, its shape " + shapeText() + " needs more",
             layout_.bytes);
    table_.end = layout_.bytes + values * item_bytes_;
    setShape();
    return std::move(table_);
  }

 private:
  [[noreturn]] void refuse(const std::string& reason, std::size_t byte = npy_dictionary) const {
    refuseByte(shown_, byte, reason);
  }

  std::string shapeText() const {
    std::string text;
    for (const std::int64_t length : layout_.shape) text += (text.empty() ? "" : " x ") + std::to_string(length);
    return text.empty() ? "of one value" : text;
  }

  void readType() {
    const std::optional<Literal> literal = LiteralParser(layout_.descr).parse();
    if (literal && literal->is_string) {
      const auto column = realType(literal->text);
      if (!column) refuse("is an array of " + quote(literal->text) + ", must be of real numbers" + remedy);
      const char* const kind = column->kind == 'f' ? "float" : column->kind == 'i' ? "int" : "uint";
      table_.type = kind + std::to_string(8 * column->size);
      table_.value = *column;
      item_bytes_ = column->size;
      return;
    }
    if (!literal || literal->items.empty()) refuse("the header of the array has no type");
    table_.type = "structures";
    has_members_ = true;
    for (const Literal& member : literal->items) readMember(member);
  }

  /// Reads a member: ('name', '<f4') or ('name', '<f4', (3,)), where 'name' may also be ('title', 'name').
  void readMember(const Literal& member) {
    if (member.items.size() < 2) refuse("the header of the array has no type");
    const Literal& named = member.items[0];
    const std::string_view name = named.is_string || named.items.size() < 2 ? named.text : named.items[1].text;
    std::uint64_t count = 1;
    if (member.items.size() > 2) {
      const Literal& lengths = member.items[2];
      for (const Literal& length : lengths.items.empty() ? std::vector{lengths} : lengths.items) {
        std::uint32_t number = 0;
        if (!parseNumber(length.text, number)) refuse("the header of the array has no type");
        count *= number;
        if (count > most_item_bytes) refuse("the member " + quote(name) + " has too many values");
      }
    }
    const std::string_view type = member.items[1].text;
    std::optional<NpyColumn> column = member.items[1].is_string ? realType(type) : std::nullopt;
    if (!column) {
      // Padding, text and bytes are skipped.
      std::uint32_t size = 0;
      const bool is_known = type.size() > 2 && std::string_view("VSU").find(type[1]) != std::string_view::npos;
      if (!is_known || !parseNumber(type.substr(2), size) || size > most_item_bytes)
        refuse("has the member " + quote(name) + " of " + (type.empty() ? "structures" : quote(type)) +
               ", must be of real numbers; in Python: numpy.save(file, numpy.column_stack((a['x'], a['y'], a['z'])))");
      item_bytes_ += count * size * (type[1] == 'U' ? 4 : 1);
      return;
    }
    if (item_bytes_ + count * column->size > most_item_bytes) refuse("has structures of too many values");
    const std::vector<std::string> names = partNames(name, static_cast<std::size_t>(count));
    for (std::size_t c = 0; c < count; ++c) {
      column->name = !names.empty() ? names[c] : std::string(name) + (count > 1 ? "_" + std::to_string(c) : "");
      column->offset = item_bytes_;
      table_.members.push_back(*column);
      item_bytes_ += column->size;
    }
    table_.columns = std::ssize(table_.members);
  }

  /// Sets sizes and strides from the shape. All dimensions except that of the columns count items.
  void setShape() {
    std::vector<std::int64_t> shape = layout_.shape;
    table_.dimensions = shape.size();
    if (has_members_ || (is_flat_ && shape.size() == 1)) shape.push_back(1);
    if (shape.size() < 2 || shape.size() > 3)
      refuse("is an array " + std::string(layout_.shape.empty() ? "" : "of ") + shapeText() + ", must be " +
             (has_members_ ? "N or H x W structures" : "N x 3 or H x W x 3 values, or more than 3"));
    std::vector<std::size_t> strides(shape.size(), item_bytes_);
    if (layout_.is_by_columns)
      for (std::size_t d = 1; d < shape.size(); ++d) strides[d] = strides[d - 1] * shape[d - 1];
    else
      for (std::size_t d = shape.size() - 1; d > 0; --d) strides[d - 1] = strides[d] * shape[d];
    if (!has_members_) table_.columns = shape.back();
    table_.column_stride = strides.back();
    table_.item_stride = strides[shape.size() - 2];
    table_.row_stride = strides.front();
    table_.width = shape[shape.size() - 2];
    table_.height = shape.size() == 3 ? shape.front() : 1;
  }

  static constexpr std::uint64_t most_item_bytes = 1 << 14;  // bytes of a structure: more than any point has

  std::string_view bytes_;
  std::size_t size_;
  const std::filesystem::path& shown_;
  bool is_flat_;
  NpyLayout layout_;
  NpyTable table_;
  bool has_members_ = false;
  std::uint64_t item_bytes_ = 0;
};

}  // namespace

Field NpyTable::field(std::int64_t c) const {
  NpyColumn column = value;
  if (members.empty())
    column.offset = static_cast<std::size_t>(c) * column_stride;
  else
    column = members[static_cast<std::size_t>(c)];
  const std::size_t size = sizeOf(column.type);
  Field field = {column.name, column.type, 1, {}};
  field.bytes.resize(static_cast<std::size_t>(rows()) * size);
  std::byte* to = field.bytes.data();
  for (std::int64_t h = 0; h < height; ++h)
    for (std::int64_t w = 0; w < width; ++w, to += size) {
      char number[sizeof(double)];
      std::memcpy(number, values + h * row_stride + w * item_stride + column.offset, column.size);
      if (column.swapped) std::reverse(number, number + column.size);
      if (column.kind == 'f' && column.size == 2) {
        std::uint16_t half = 0;
        std::memcpy(&half, number, sizeof(half));
        const float single = fromHalf(half);
        std::memcpy(number, &single, sizeof(single));
      }
      std::memcpy(to, number, size);
    }
  return field;
}

NpyTable parseNpyTable(std::string_view bytes, std::size_t size, const std::filesystem::path& shown, bool is_flat) {
  return TableParser(bytes, size, shown, is_flat).parse();
}

}  // namespace tufted::io
