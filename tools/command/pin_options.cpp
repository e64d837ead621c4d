#include "pin_options.h"

#include <CLI/CLI.hpp>

#include "options.h"
#include "point_options.h"
#include "tufted/errors.h"

namespace {

struct Pin {
  std::vector<double> place, values;
  std::string name;
};

Pin parsePin(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) throw tufted::InvalidInput("--pin " + text + " is not INDEX=V or X,Y,Z=V");
  return {parseNumbers(text.substr(0, equals), "--pin"), parseNumbers(text.substr(equals + 1), "--pin"),
          "--pin " + text};
}

/// Reads pins from a file.
/// @param columns number of columns that name the point: 1 for an index, 3 for a position
void readPins(const std::filesystem::path& path, std::ptrdiff_t columns, std::vector<Pin>& pins) {
  if (path.empty()) return;
  for (const Row& row : readRows(path)) {
    if (std::ssize(row.numbers) <= columns)
      throw tufted::IoError(row.name + ": is not " + (columns == 1 ? "INDEX" : "X Y Z") + " V1 V2 ...");
    const auto end = row.numbers.begin() + columns;
    pins.push_back({{row.numbers.begin(), end}, {end, row.numbers.end()}, row.name});
  }
}

}  // namespace

void addPinOptions(CLI::App& command, PinOptions& options) {
  command
      .add_option(
          "--pin", options.pins,
          "Pin: the value (V1,V2,... for several) at a point, or at the point nearest to a position; may be repeated")
      ->allow_extra_args(false)
      ->type_name("INDEX=V|X,Y,Z=V");
  addText(command, "--pins TEXT", options.by_index, "Text file of pins, lines INDEX V1 V2 ...");
  addText(command, "--pins-near TEXT", options.by_position,
          "Text file of pins at the points nearest to positions, lines X Y Z V1 V2 ...");
}

PlacedPins placePins(const PinOptions& options, const Operator& source) {
  std::vector<Pin> given;
  readPins(options.by_index, 1, given);
  readPins(options.by_position, 3, given);
  for (const std::string& text : options.pins) given.push_back(parsePin(text));
  if (given.empty())
    throw tufted::InvalidInput("no pin is given, must be at least one by --pin, --pins or --pins-near");
  const auto columns = std::ssize(given.front().values);
  PlacedPins pins{{}, Eigen::MatrixXd(std::ssize(given), columns)};
  for (const Pin& pin : given) {
    if (pin.values.empty() || std::ssize(pin.values) != columns)
      throw tufted::InvalidInput(pin.name + " has " + std::to_string(pin.values.size()) + " values, must have " +
                                 (columns == 0 ? "at least one" : std::to_string(columns) + " as the first"));
    pins.values.row(std::ssize(pins.places)) = Eigen::Map<const Eigen::RowVectorXd>(pin.values.data(), columns);
    pins.places.push_back(placeOf(pin.place, source, pin.name));
  }
  if (!pins.values.allFinite()) throw tufted::InvalidInput("a pin has a value that is not finite, must have none");
  return pins;
}

tufted::Pins PlacedPins::locate(const Operator& source, Results& results) const {
  const std::vector<int> points = ::locate(places, source, results);
  noteLeftOut(points, source, results);
  return {points, values};
}
