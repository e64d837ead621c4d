#pragma once

#include <CLI/App.hpp>
#include <Eigen/Core>
#include <string>
#include <vector>

#include "operator.h"

/// Numbers separated by commas. @throws InvalidInput naming the option
std::vector<double> parseNumbers(const std::string& text, const std::string& option);

/// Points that the user names: by index or as the nearest to a position.
struct NamedPoints {
  std::vector<int> indices;
  std::vector<std::string> positions;  ///< X,Y,Z
};

/// Adds --source I,J,... and --near X,Y,Z, which may be repeated.
void addPointOptions(CLI::App& command, NamedPoints& points, const std::string& what);

/// The nearest active point of the source. @throws InvalidInput where it has no points
int nearestOf(const Operator& source, const Eigen::Vector3d& position);

/// All points named, those by index first.
std::vector<int> indicesOf(const NamedPoints& points, const Operator& source);
