#pragma once

#include <CLI/App.hpp>
#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "operator.h"

/// Values of the options that name functions on the points.
struct SignalOptions {
  std::vector<std::string> fields;
  std::filesystem::path values;
};

/// Adds --field and --values.
void addSignalOptions(CLI::App& command, SignalOptions& options, const std::string& what);

/// Reads the functions. `source` need not have its Laplacian yet.
/// @return N x c
/// @throws InvalidInput unless one of --field and --values is given, or for a field that the source does not have;
/// IoError as readArray(), and for an array that does not have N rows
Eigen::MatrixXd readSignals(const SignalOptions& options, const Operator& source);

/// @throws IoError if signals are not finite at an active point
void requireFinite(const Eigen::MatrixXd& signals, const Operator& source);
