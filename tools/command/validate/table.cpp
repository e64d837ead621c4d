#include "table.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <utility>

namespace {

using Json = nlohmann::ordered_json;

std::string integer(const Json& value) {
  return std::to_string(value.get<std::int64_t>());
}

std::string printed(const char* format, double value) {
  char text[32];
  std::snprintf(text, sizeof(text), format, value);
  return text;
}

std::string rounded(const Json& value) {
  return printed("%.0f", value.get<double>());
}

std::string hundredths(const Json& value) {
  return printed("%.2f", value.get<double>());
}

std::string magnitude(const Json& value) {
  return value == 0 ? "0" : printed("%.0e", value.get<double>());
}

std::string yesOrNo(const Json& value) {
  return value.get<bool>() ? "yes" : "NO";
}

struct Column {
  const char* title;
  int width;
  const char* member;
  std::string (*text)(const Json&);
};

constexpr Column columns[] = {
    {"points", 9, "points", integer},
    {"faces", 9, "faces", integer},
    {"seconds", 8, "seconds", hundredths},
    {"MB", 6, "memory_mb", rounded},
    {"nnz/row", 8, "nonzeros_per_row", hundredths},
    {"flips", 9, "flips", integer},
    {">0", 4, "positive_off_diagonals", integer},
    {"clamped", 8, "largest_clamped", magnitude},
    {"asym", 6, "symmetry_error", magnitude},
    {"rowsum", 7, "row_sum_error", magnitude},
    {"recomp", 7, "weight_error", magnitude},
    {"psd", 4, "definite", yesOrNo},
    {"parts", 6, "components", integer},
    {"active", 9, "active", integer},
    {"not fin", 8, "not_finite_points", integer},
    {"coinc", 7, "coincident", integer},
    {"isol", 6, "isolated", integer},
};

std::string aligned(const std::string& text, int width) {
  const int gap = width - static_cast<int>(text.size());
  return std::string(std::max(gap, 1), ' ') + text;
}

/// One line whatever the text: names of files and messages may hold anything.
std::string oneLine(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 127; }, '?');
  return text;
}

std::string resultCell(std::string text) {
  constexpr std::size_t width = 7;
  text.resize(std::max(width, text.size()), ' ');
  return text;
}

}  // namespace

std::string tableHeader() {
  std::string line = resultCell("result");
  for (const Column& column : columns) line += aligned(column.title, column.width);
  return line + "  file";
}

std::string tableLine(const Json& row) {
  std::string line = resultCell(row.at("result").get<std::string>());
  for (const Column& column : columns) {
    const auto member = row.find(column.member);
    const bool known = member != row.end() && !member->is_null();
    line += aligned(known ? column.text(*member) : "-", column.width);
  }
  line += "  " + row.at("file").get<std::string>();
  std::string separator = ": ";
  for (const char* member : {"reasons", "not_checked"}) {
    if (!row.contains(member)) continue;
    for (const Json& reason : row[member]) line += std::exchange(separator, "; ") + reason.get<std::string>();
  }
  return oneLine(line);
}
