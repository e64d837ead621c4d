#pragma once

#include <CLI/App.hpp>
#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "operator.h"
#include "point_options.h"
#include "tufted/interpolation.h"

/// The pins as the user gives them.
struct PinOptions {
  std::vector<std::string> pins;
  std::filesystem::path by_index, by_position;

  bool empty() const { return pins.empty() && by_index.empty() && by_position.empty(); }
};

/// Adds --pin, --pins and --pins-near.
void addPinOptions(CLI::App& command, PinOptions& options);

/// Pins before the nearest points are known.
struct PlacedPins {
  std::vector<Place> places;
  Eigen::MatrixXd values;

  /// Notes in `results` which points were nearest.
  tufted::Pins locate(const Operator& source, Results& results) const;
};

/// @throws InvalidInput for no pin, pins that are not valid, or numbers of values that differ; IoError as readRows()
PlacedPins placePins(const PinOptions& options, int points);
