#include "table.h"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace {

struct Column {
  const char* title;
  int width;
  const char* member;
  const char* format;  ///< printf format for decimals
};

constexpr Column columns[] = {{"points", 9, "points", ""},
                              {"faces", 9, "faces", ""},
                              {"seconds", 8, "seconds", "%.2f"},
                              {"MB", 6, "memory_mb", "%.0f"},
                              {"nnz/row", 8, "nonzeros_per_row", "%.2f"},
                              {"flips", 9, "flips", ""},
                              {">0", 4, "positive_off_diagonals", ""},
                              {"clamped", 8, "largest_clamped", "%.0e"},
                              {"asym", 6, "symmetry_error", "%.0e"},
                              {"rowsum", 7, "row_sum_error", "%.0e"},
                              {"recomp", 7, "weight_error", "%.0e"},
                              {"psd", 4, "definite", ""},
                              {"parts", 6, "components", ""},
                              {"active", 9, "active", ""},
                              {"not fin", 8, "not_finite_points", ""},
                              {"coinc", 7, "coincident", ""},
                              {"isol", 6, "isolated", ""}};

std::string cell(const nlohmann::ordered_json& row, const Column& column) {
  const nlohmann::ordered_json value = row.value(column.member, nlohmann::ordered_json());
  if (value.is_null()) return "-";
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "NO";
  if (!value.is_number_float() || value == 0) return value.is_number_float() ? "0" : value.dump();
  char text[32];
  std::snprintf(text, sizeof(text), column.format, value.get<double>());
  return text;
}

std::string aligned(const std::string& text, int width) {
  return std::string(static_cast<std::size_t>(std::max(width - static_cast<int>(text.size()), 1)), ' ') + text;
}

}  // namespace

std::string tableHeader() {
  std::string line = "result ";
  for (const Column& column : columns) line += aligned(column.title, column.width);
  return line + "  file";
}

std::string tableLine(const nlohmann::ordered_json& row) {
  std::string line = row.at("result").get<std::string>();
  line.resize(std::max(line.size(), std::size_t{7}), ' ');  // the length of "REFUSED", the longest
  for (const Column& column : columns) line += aligned(cell(row, column), column.width);
  line += "  " + row.at("file").get<std::string>();
  std::string separator = ": ";
  for (const char* member : {"reasons", "not_checked"})
    for (const nlohmann::ordered_json& reason : row.value(member, nlohmann::ordered_json::array()))
      line += std::exchange(separator, "; ") + reason.get<std::string>();
  // Names of files and messages may contain control characters, such as newlines.
  std::ranges::replace_if(
      line, [](unsigned char c) { return c < ' ' || c == 127; }, '?');
  return line;
}
