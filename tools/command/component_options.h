#pragma once

#include <CLI/App.hpp>
#include <string>

struct Operator;
struct Results;

/// Which connected components take part.
struct ComponentOptions {
  std::string chosen;  ///< "largest", or labels with commas; empty: all
  int min_points = 1;
};

/// Adds --component and --min-component.
void addComponentOptions(CLI::App& command, ComponentOptions& options);

/// Leaves out the other components of the source, and says in the results how many there are.
/// @throws InvalidInput where none is left, or for a label that no component has
void chooseComponents(const ComponentOptions& options, Operator& source, Results& results);
