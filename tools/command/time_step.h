#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "operator.h"

// The time that heat has to spread, which a user may set.

/// Adds --time-step.
CLI::Option* addTimeStep(CLI::App& command, std::optional<double>& time_step, const std::string& text);

/// Refuses a time step in which heat spreads over everything, or hardly at all. In a time t it goes as far as the root
/// of t. Distances are 5 % too short if that is a sixth of an edge (--time-step 0.03), 13 % at a thirtieth, 20 % at a
/// thousandth, and finally they are meaningless.
/// @param time_step as given; without one there is nothing to refuse: the defaults do for any shape, also for a
/// tetrahedron, over all of which heat spreads
/// @param time that it means, in the points' unit squared
/// @throws InvalidInput
void checkTimeStep(const std::optional<double>& time_step, double time, const Operator& source);
