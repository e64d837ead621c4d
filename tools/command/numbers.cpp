#include "numbers.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <utility>

#include "options.h"
#include "tufted/errors.h"

std::vector<double> parseNumbers(const std::string& text, const std::string& option) {
  std::vector<double> numbers;
  std::istringstream words(text + ',');
  bool valid = true;
  for (std::string word; std::getline(words, word, ',');) valid &= parseNumber(word, numbers.emplace_back());
  if (!valid) throw tufted::InvalidInput(option + " " + text + " is no list of numbers with commas between them");
  return numbers;
}

std::vector<Row> readRows(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file || std::filesystem::is_directory(path)) throw tufted::IoError(path.string() + ": cannot be read");
  std::vector<Row> rows;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    line.resize(std::min(line.find('#'), line.size()));
    std::replace(line.begin(), line.end(), ',', ' ');
    Row row{path.string() + ": line " + std::to_string(number), {}};
    std::istringstream words(line);
    for (std::string word; words >> word;)
      if (!parseNumber(word, row.numbers.emplace_back()))
        throw tufted::IoError(row.name + ": '" + word + "' is not a number");
    if (!row.numbers.empty()) rows.push_back(std::move(row));
  }
  return rows;
}
