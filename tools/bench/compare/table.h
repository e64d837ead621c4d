#pragma once

#include <cstdio>
#include <filesystem>
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

/// Prints rows in Markdown as they come, and keeps them for JSON and drawings.
class Table {
 public:
  explicit Table(std::vector<std::string> columns) : columns_(std::move(columns)) {
    for (const std::string& column : columns_) std::printf("| %s ", column.c_str());
    std::printf("|\n");
    for (std::size_t c = 0; c < columns_.size(); ++c) std::printf("|---");
    std::printf("|\n");
  }
  void row(const std::vector<Cell>& cells) {
    for (const Cell& cell : cells) std::printf("| %s ", cell.text.c_str());
    std::printf("|\n");
    std::fflush(stdout);
    rows_.push_back(cells);
  }
  const std::vector<std::string>& columns() const { return columns_; }
  const std::vector<std::vector<Cell>>& rows() const { return rows_; }
  nlohmann::ordered_json json() const {
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    for (const std::vector<Cell>& cells : rows_) {
      nlohmann::ordered_json& row = all.emplace_back();
      for (std::size_t c = 0; c < cells.size(); ++c) row[columns_[c]] = cells[c].value;
    }
    return all;
  }

 private:
  std::vector<std::string> columns_;
  std::vector<std::vector<Cell>> rows_;
};

/// Draws a table as SVG: a point for each number, in a panel for each column.
/// @throws std::runtime_error if the file cannot be written
void drawTable(const Table& table, const std::string& title, const std::filesystem::path& path);

}  // namespace tufted::bench
