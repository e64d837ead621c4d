#pragma once

#include <CLI/App.hpp>
#include <string>

struct Operator;
struct Results;

/// Which connected components are used.
struct ComponentOptions {
  std::string chosen;  ///< "largest", or labels separated by commas; empty: all
  int min_points = 1;
};

/// Adds --component and --min-component.
void addComponentOptions(CLI::App& command, ComponentOptions& options);

/// Restricts the source to the chosen components, and notes their number in the results.
/// @throws InvalidInput if none is left, or for a label that no component has
void chooseComponents(const ComponentOptions& options, Operator& source, Results& results);
