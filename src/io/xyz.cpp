#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "io/columns.h"
#include "io/errors.h"
#include "io/field_names.h"
#include "io/formats.h"
#include "io/line_scanner.h"
#include "io/number.h"
#include "io/text_heading.h"
#include "io/unread.h"

namespace tufted::io {
namespace {

constexpr LineScanner::Syntax xyz_syntax = {
    .separators = " \t\r\f\v,;\"", .delimiters = ",;", .comment = '#', .line_comment = "//"};

/// Rows with the same number of values.
struct Numbers {
  std::vector<double> values;
  std::size_t columns = 0;
  bool go_on = false;  ///< whether more rows follow than were announced, from the scanner's current line on

  std::size_t rows() const { return columns == 0 ? 0 : values.size() / columns; }
};

/// Sets the number of columns from the first row, and makes the heading's names match it.
void begin(const LineScanner& scanner, TextHeading& heading, Numbers& numbers) {
  numbers.columns = scanner.tokens().size();
  if (numbers.columns < 3) scanner.refuse("three coordinates expected");
  auto& names = heading.names;
  if (names.empty()) return;
  if (heading.may_lack_index && names.size() + 1 == numbers.columns) names.insert(names.begin(), "");
  if (names.size() == numbers.columns) return;
  if (!heading.is_comment)
    scanner.refuse("line " + std::to_string(heading.line) + " names " + std::to_string(names.size()) +
                   " columns, here are " + std::to_string(numbers.columns));
  names.clear();
}

Numbers readNumbers(LineScanner& scanner, TextHeading& heading) {
  if (heading.end > 0) scanner.seek(heading.end, heading.lines);
  Numbers numbers;
  std::optional<std::int64_t> announced = heading.count;
  while (scanner.next()) {
    const auto& tokens = scanner.tokens();
    const bool is_complete = announced && static_cast<std::uint64_t>(*announced) <= numbers.rows();
    // A line of one number is a number of points: before the first row, or in PTS files before each of several scans.
    if (tokens.size() == 1 && (numbers.columns == 0 ? !announced : is_complete)) {
      const std::int64_t count = scanner.integer(0);
      if (count < 0) scanner.refuse("a number of points below zero");
      if (count > std::numeric_limits<std::int64_t>::max() - announced.value_or(0)) scanner.refuse("too many points");
      announced = announced.value_or(0) + count;
      continue;
    }
    if (numbers.columns == 0) begin(scanner, heading, numbers);
    if (is_complete) {
      numbers.go_on = true;
      return numbers;
    }
    if (tokens.size() != numbers.columns)
      scanner.refuse(std::to_string(tokens.size()) + " values where " + std::to_string(numbers.columns) +
                     " are expected");
    for (std::size_t t = 0; t < tokens.size(); ++t) numbers.values.push_back(scanner.number(t));
  }
  if (numbers.columns == 0) scanner.refuse("holds no points up to there");
  if (announced && static_cast<std::uint64_t>(*announced) > numbers.rows())
    scanner.refuse("ends after " + std::to_string(numbers.rows()) + " of " + std::to_string(*announced) + " points");
  return numbers;
}

/// Names the columns by the heading, by the order in Leica's PTS, or by nameByPlace().
void name(const std::filesystem::path& path, const TextHeading& heading, Columns& columns) {
  const std::string extension = lower(path.extension().string());
  std::vector<std::string> names = heading.names;
  const std::size_t count = columns.fields.size();
  if (names.empty() && extension == ".pts" && (count == 4 || count == 7)) {
    names = {"x", "y", "z", "intensity", "red", "green", "blue"};
    names.resize(count);
  }
  if (names.empty()) return nameByPlace(columns, extension == ".pwn" || extension == ".xyzn");
  for (std::size_t c = 0; c < count; ++c) columns.fields[c].name = names[c];
  nameColumns(path, heading.line, columns.fields);
}

/// Converts colours that are integers up to 255 to bytes, as other formats have them.
void narrowColors(Columns& columns) {
  const auto isByte = [](double value) { return value >= 0 && value <= 255 && value == std::trunc(value); };
  for (Field& field : columns.fields) {
    if (!isOneOf(field.name, {"red", "green", "blue", "alpha"})) continue;
    std::vector<std::byte> bytes;
    for (std::int64_t i = 0; i < columns.rows; ++i) {
      const double value = tufted::valueOf(field, static_cast<std::size_t>(i));
      if (!isByte(value)) break;
      bytes.push_back(static_cast<std::byte>(value));
    }
    if (std::ssize(bytes) < columns.rows) continue;
    field.type = FieldType::uint8;
    field.bytes = std::move(bytes);
  }
}

}  // namespace

bool looksLikeXyz(std::string_view bytes) {
  if (const TextHeading heading = readHeading(bytes); heading.end > 0) return namePoints(heading.names);
  const auto tokens = firstTokens(bytes, xyz_syntax);
  double value = 0;
  return (tokens.size() == 1 || tokens.size() >= 3) &&
         std::all_of(tokens.begin(), tokens.end(), [&](std::string_view token) { return parseNumber(token, value); });
}

Geometry readXyz(const std::filesystem::path& path, std::string_view text) {
  TextHeading heading = readHeading(text);
  LineScanner scanner(path, text, xyz_syntax);
  const Numbers numbers = readNumbers(scanner, heading);
  Columns columns;
  columns.fields.resize(numbers.columns, {"", FieldType::float64, 1, {}});
  allocate(columns, checkedRows(path, static_cast<std::int64_t>(numbers.rows())));
  for (std::size_t i = 0; i < numbers.rows(); ++i) {
    for (std::size_t c = 0; c < numbers.columns; ++c)
      std::memcpy(columns.fields[c].bytes.data() + i * sizeof(double), &numbers.values[i * numbers.columns + c],
                  sizeof(double));
  }
  name(path, heading, columns);
  narrowColors(columns);
  Geometry geometry = toGeometry(std::move(columns));
  geometry.format = "text in columns";
  if (numbers.go_on) noteUnreadFromHere(path, text, scanner, geometry);
  return geometry;
}

}  // namespace tufted::io
