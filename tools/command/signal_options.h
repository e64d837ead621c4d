#pragma once

#include <CLI/App.hpp>
#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "operator.h"

/// Functions on the points, as the user names them.
struct SignalOptions {
  std::vector<std::string> fields;
  std::filesystem::path values;
};

/// Adds --field and --values.
void addSignalOptions(CLI::App& command, SignalOptions& options, const std::string& what);

/// Reads them; `source` need not have its Laplacian yet.
/// @returns N x c
/// @throws InvalidInput unless one of both is given, and for fields that the source does not have; IoError as
///         readArray(), and for an array that does not have N rows
Eigen::MatrixXd readSignals(const SignalOptions& options, const Operator& source);

/// @throws IoError where signals are not finite at an active point
void requireFinite(const Eigen::MatrixXd& signals, const Operator& source);
