#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "operator.h"

/// Size and spacing of a surface, with which lengths and times that a user gives are compared.
struct Extent {
  std::string name;  ///< name of the source, for messages
  double size = 0;   ///< diagonal of the box of the active points, or the root of the area if that is larger, as for a
                     ///< rolled-up surface, or the points are unknown
  double spacing = 0;  ///< mean edge length

  /// "FILE has the size 0.25 and the spacing 0.002", for messages.
  std::string text() const;
};

Extent extentOf(const Operator& source);

/// Adds --time-step.
CLI::Option* addTimeStep(CLI::App& command, std::optional<double>& time_step, const std::string& text);

/// Refuses a time step in which heat spreads over the whole surface, or less than a hundredth of an edge. In a time t
/// it spreads as far as the root of t. Distances are 5 % too short if that is a sixth of an edge (--time-step 0.03), 13
/// % at a thirtieth, 20 % at a thousandth.
/// @param time_step as given; empty: nothing is refused, as the default is right for any shape, even a tetrahedron
/// @param time the time that it stands for, in the points' unit squared
/// @throws InvalidInput
void checkTimeStep(const std::optional<double>& time_step, double time, const Operator& source);
