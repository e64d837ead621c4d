#include "point_options.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <sstream>

#include "tufted/errors.h"
#include "tufted/nearest_point.h"

std::vector<double> parseNumbers(const std::string& text, const std::string& option) {
  std::vector<double> numbers;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    double number = 0;
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, number);
    if (error != std::errc() || stop != end)
      throw tufted::InvalidInput(option + " " + text + " is no list of numbers with commas between them");
    numbers.push_back(number);
  }
  return numbers;
}

void addPointOptions(CLI::App& command, NamedPoints& points, const std::string& what) {
  const auto set_indices = [&points](const std::vector<int>& indices) { points.indices = indices; };
  command.add_option_function<std::vector<int>>("--source", set_indices, what + ", by index from 0")
      ->delimiter(',')
      ->allow_extra_args(false)  // what follows may be FILE
      ->type_name("I,J,...");
  command.add_option("--near", points.positions, what + ", as the point nearest to this")
      ->allow_extra_args(false)
      ->type_name("X,Y,Z");
}

int nearestOf(const Operator& source, const Eigen::Vector3d& position) {
  if (source.geometry.points.rows() == 0)
    throw tufted::InvalidInput("a position needs points, and the folder of --operator has none");
  return tufted::nearestPoint(source.laplacian, source.geometry.points, position);
}

std::vector<int> indicesOf(const NamedPoints& points, const Operator& source) {
  std::vector<int> indices = points.indices;
  for (const std::string& text : points.positions) {
    const std::vector<double> numbers = parseNumbers(text, "--near");
    if (numbers.size() != 3) throw tufted::InvalidInput("--near " + text + " is not X,Y,Z");
    indices.push_back(nearestOf(source, {numbers[0], numbers[1], numbers[2]}));
  }
  return indices;
}
