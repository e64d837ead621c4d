#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <optional>

#include "io/columns.h"
#include "io/errors.h"
#include "io/formats.h"
#include "io/line_scanner.h"
#include "io/number.h"

namespace tufted::io {
namespace {

constexpr LineScanner::Syntax syntax = {
    .separators = " \t\r\f\v,;", .delimiters = ",;", .comment = '#', .line_comment = "//"};

/// Rows of equally many numbers.
struct Numbers {
  std::vector<std::string> names;  ///< of the columns, where the first line gives them
  std::vector<double> values;
  std::size_t columns = 0;

  std::size_t rows() const { return columns == 0 ? 0 : values.size() / columns; }
};

/// A first line of names, as in `x,y,z,intensity`.
bool isHeading(const std::vector<std::string_view>& tokens) {
  return tokens.size() >= 3 && std::none_of(tokens.begin(), tokens.end(), [](std::string_view token) {
           double value;
           return parseNumber(token, value);
         });
}

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), [](unsigned char c) { return std::tolower(c); });
  return result;
}

Numbers readNumbers(const std::filesystem::path& path, std::string_view text) {
  LineScanner scanner(path, text, syntax);
  Numbers numbers;
  std::optional<std::int64_t> announced;
  while (scanner.next()) {
    const auto& tokens = scanner.tokens();
    if (numbers.columns == 0) {
      if (tokens.size() == 1 && !announced) {  // some writers put the number of points first
        announced = scanner.integer(0);
        if (*announced < 0) scanner.refuse("a number of points below zero");
        continue;
      }
      if (numbers.names.empty() && isHeading(tokens)) {
        for (const std::string_view token : tokens) numbers.names.push_back(lower(token));
        continue;
      }
      numbers.columns = tokens.size();
      if (numbers.columns < 3) scanner.refuse("three coordinates expected");
      if (!numbers.names.empty() && numbers.names.size() != numbers.columns)
        scanner.refuse("the first line names " + std::to_string(numbers.names.size()) + " columns, here are " +
                       std::to_string(numbers.columns));
    }
    if (tokens.size() != numbers.columns)
      scanner.refuse(std::to_string(tokens.size()) + " values where " + std::to_string(numbers.columns) +
                     " are expected");
    for (std::size_t t = 0; t < tokens.size(); ++t) numbers.values.push_back(scanner.number(t));
  }
  if (numbers.columns == 0) scanner.refuse("holds no points up to there");
  if (announced && static_cast<std::uint64_t>(*announced) > numbers.rows())
    refuseLine(path, scanner.line(),
               "ends after " + std::to_string(numbers.rows()) + " of " + std::to_string(*announced) + " points");
  return numbers;
}

/// Whether columns 3, 4, 5 hold unit vectors (or zero, or NaN), not colours.
bool holdNormals(const Numbers& numbers) {
  bool any = false;
  for (std::size_t i = 0; i < numbers.rows(); ++i) {
    const double* row = numbers.values.data() + i * numbers.columns;
    const double length = std::hypot(row[3], row[4], row[5]);
    if (length == 0 || std::isnan(length)) continue;
    if (std::abs(length - 1) > 0.02) return false;
    any = true;
  }
  return any;
}

std::vector<std::string> columnNames(const std::filesystem::path& path, const Numbers& numbers) {
  if (!numbers.names.empty()) return numbers.names;
  std::vector<std::string> names = {"x", "y", "z"};
  const std::string extension = lower(path.extension().string());
  if (numbers.columns >= 6 && (extension == ".pwn" || extension == ".xyzn" || holdNormals(numbers)))
    names.insert(names.end(), {"nx", "ny", "nz"});
  while (names.size() < numbers.columns) names.push_back("column" + std::to_string(names.size()));
  return names;
}

}  // namespace

bool looksLikeXyz(std::string_view bytes) {
  const auto tokens = firstTokens(bytes, syntax);
  if (isHeading(tokens)) {
    const auto named = [&tokens](const char* name) {
      return std::any_of(tokens.begin(), tokens.end(), [name](std::string_view token) { return lower(token) == name; });
    };
    return named("x") && named("y") && named("z");
  }
  double value;
  return (tokens.size() == 1 || tokens.size() >= 3) &&
         std::all_of(tokens.begin(), tokens.end(), [&](std::string_view token) { return parseNumber(token, value); });
}

Geometry readXyz(const std::filesystem::path& path, std::string_view text) {
  const Numbers numbers = readNumbers(path, text);
  Columns columns;
  for (std::string& name : columnNames(path, numbers))
    columns.fields.push_back({std::move(name), FieldType::float64, 1, {}});
  allocate(columns, checkedRows(path, static_cast<std::int64_t>(numbers.rows())));
  for (std::size_t i = 0; i < numbers.rows(); ++i) {
    for (std::size_t c = 0; c < numbers.columns; ++c)
      std::memcpy(columns.fields[c].bytes.data() + i * sizeof(double), &numbers.values[i * numbers.columns + c],
                  sizeof(double));
  }
  Geometry geometry = toGeometry(path, 1, std::move(columns));
  geometry.format = "text in columns";
  return geometry;
}

}  // namespace tufted::io
