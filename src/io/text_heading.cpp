#include "io/text_heading.h"

#include <algorithm>
#include <functional>

#include "io/field_names.h"
#include "io/number.h"

namespace tufted::io {
namespace {

constexpr std::string_view blanks = " \t\f\v";

std::string_view strip(std::string_view text) {
  const std::size_t begin = std::min(text.find_first_not_of(blanks), text.size());
  return text.substr(begin, text.find_last_not_of(blanks) + 1 - begin);
}

/// Takes the next line, which ends with \n, \r\n or a lone \r, off `rest`.
std::string_view takeLine(std::string_view& rest) {
  const std::size_t end = std::min(rest.find_first_of("\r\n"), rest.size());
  const std::string_view line = rest.substr(0, end);
  rest.remove_prefix(end);
  rest.remove_prefix(rest.starts_with("\r\n") ? 2 : rest.empty() ? 0 : 1);
  return line;
}

/// Splits a line at commas if it has any, otherwise at semicolons, tabs or blanks, in this order, except in quotes.
std::vector<std::string> split(std::string_view line) {
  line = line.substr(0, line.find_last_not_of(",;\t ") + 1);  // a delimiter at the end of a line is ignored
  char delimiter = ' ';
  for (const char c : {'\t', ';', ','})
    if (line.find(c) != std::string_view::npos) delimiter = c;
  std::vector<std::string> pieces(1);
  bool in_quotes = false;
  for (const char c : line) {
    if (c == '"') in_quotes = !in_quotes;
    if (c != delimiter || in_quotes)
      pieces.back() += c;
    else if (delimiter != ' ' || !pieces.back().empty())
      pieces.emplace_back();
  }
  return pieces;
}

bool isNumber(const std::string& text) {
  double value = 0;
  return parseNumber(plainName(text), value);
}

}  // namespace

bool namePoints(const std::vector<std::string>& names) {
  std::vector<Field> fields;
  for (const std::string& name : names) fields.push_back({name, FieldType::float64, 1, {}});
  nameFields(fields);
  const auto has = [&fields](const char* axis) {
    return std::any_of(fields.begin(), fields.end(), [axis](const Field& field) { return field.name == axis; });
  };
  return has("x") && has("y") && has("z");
}

TextHeading readHeading(std::string_view text) {
  TextHeading heading;
  std::string_view rest = text;
  if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);
  for (std::int64_t line = 1; !rest.empty(); ++line) {
    const std::string_view whole = takeLine(rest), content = strip(whole);
    if (content.empty()) continue;
    if (content.starts_with('#') || content.starts_with("//")) {
      std::vector<std::string> names = split(content.substr(std::min(content.find_first_not_of("#/"), content.size())));
      if (!namePoints(names)) continue;
      heading.names = std::move(names);
      heading.is_comment = true;
      heading.line = line;
      continue;
    }
    std::vector<std::string> pieces = split(whole);
    std::int64_t count = 0;
    if (pieces.size() == 1 && !heading.count && parseNumber(plainName(pieces[0]), count) && count >= 0) {
      heading.count = count;
      continue;
    }
    const bool are_words = pieces.size() >= 3 && std::none_of(pieces.begin(), pieces.end(), isNumber);
    if (!are_words && !(std::any_of(pieces.begin(), pieces.end(), std::not_fn(isNumber)) && namePoints(pieces))) break;
    heading.names = std::move(pieces);
    heading.is_comment = false;
    heading.line = heading.lines = line;
    heading.end = static_cast<std::size_t>(rest.data() - text.data());
    const bool is_indented = whole.front() == ' ' && !rest.starts_with(' ');
    heading.may_lack_index = is_indented || strip(rest).starts_with('"');
    break;
  }
  if (heading.end == 0) heading.count.reset();
  return heading;
}

}  // namespace tufted::io
