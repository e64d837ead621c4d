#pragma once

#include <cstdio>
#include <string>
#include <vector>

namespace tufted::bench {

/// What a cell of a table shows.
struct Cell {
  std::string text;

  Cell(const char* word) : text(word) {}              // NOLINT: cells are written as lists of words
  Cell(const std::string& word) : text(word) {}       // NOLINT
  Cell(int number) : text(std::to_string(number)) {}  // NOLINT
  /// A number by a format of printf.
  Cell(const char* format, double number) {
    char line[64];
    std::snprintf(line, sizeof line, format, number);
    text = line;
  }
};
/// A share as a percentage.
inline Cell percent(double share, const char* format = "%.1f %%") {
  return {format, 100 * share};
}

/// Prints rows in Markdown as they come.
class Table {
 public:
  explicit Table(const std::vector<std::string>& columns) {
    for (const std::string& column : columns) std::printf("| %s ", column.c_str());
    std::printf("|\n");
    for (std::size_t c = 0; c < columns.size(); ++c) std::printf("|---");
    std::printf("|\n");
  }
  void row(const std::vector<Cell>& cells) {
    for (const Cell& cell : cells) std::printf("| %s ", cell.text.c_str());
    std::printf("|\n");
    std::fflush(stdout);
  }
};

}  // namespace tufted::bench
