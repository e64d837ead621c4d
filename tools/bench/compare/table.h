#pragma once

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace tufted::bench {

/// A cell of a table: what is printed, and the number for JSON.
struct Cell {
  std::string text;
  nlohmann::ordered_json value;

  Cell(const char* word) : text(word), value(word) {}                // NOLINT: cells are written as lists of words
  Cell(const std::string& word) : Cell(word.c_str()) {}              // NOLINT
  Cell(int number) : text(std::to_string(number)), value(number) {}  // NOLINT
  /// A number by a format of printf.
  Cell(const char* format, double number) : value(number) {
    char line[64];
    std::snprintf(line, sizeof line, format, number);
    text = line;
  }
};
/// A share as a percentage.
inline Cell percent(double share, const char* format = "%.1f %%") {
  Cell cell(format, 100 * share);
  cell.value = share;
  return cell;
}

/// Prints rows in Markdown as they come, and keeps them for JSON.
class Table {
 public:
  explicit Table(std::vector<std::string> columns) : columns_(std::move(columns)) {
    for (const std::string& column : columns_) std::printf("| %s ", column.c_str());
    std::printf("|\n");
    for (std::size_t c = 0; c < columns_.size(); ++c) std::printf("|---");
    std::printf("|\n");
  }
  void row(const std::vector<Cell>& cells) {
    nlohmann::ordered_json row;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      std::printf("| %s ", cells[c].text.c_str());
      row[columns_[c]] = cells[c].value;
    }
    std::printf("|\n");
    std::fflush(stdout);
    rows_.push_back(row);
  }
  const nlohmann::ordered_json& json() const { return rows_; }

 private:
  std::vector<std::string> columns_;
  nlohmann::ordered_json rows_ = nlohmann::ordered_json::array();
};

}  // namespace tufted::bench
