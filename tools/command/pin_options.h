#pragma once

#include <CLI/App.hpp>
#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "operator.h"
#include "point_options.h"
#include "tufted/interpolation.h"

struct PinOptions {
  std::vector<std::string> pins;
  std::filesystem::path by_index, by_position;

  bool empty() const { return pins.empty() && by_index.empty() && by_position.empty(); }
};

/// Adds --pin, --pins and --pins-near.
void addPinOptions(CLI::App& command, PinOptions& options);

/// Pins whose positions are not yet matched to points.
struct PlacedPins {
  std::vector<Place> places;
  Eigen::MatrixXd values;

  /// Finds the points nearest to positions, and notes them in `results`.
  tufted::Pins locate(const Operator& source, Results& results) const;
};

/// Parses the pins.
/// @throws InvalidInput for no pin, invalid pins, or different numbers of values; IoError as readRows()
PlacedPins placePins(const PinOptions& options, const Operator& source);
