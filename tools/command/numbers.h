#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// Parses numbers separated by commas. @throws InvalidInput naming the option
std::vector<double> parseNumbers(const std::string& text, const std::string& option);

/// Numbers in a line of a text file.
struct Row {
  std::string name;  ///< "path: line 12", for messages
  std::vector<double> numbers;
};

/// Reads lines of numbers separated by blanks or commas. Empty lines and text after a # are skipped.
/// @throws IoError for a file that cannot be read or a word that is no number
std::vector<Row> readRows(const std::filesystem::path& path);
