#pragma once

#include <CLI/App.hpp>

#include "operator.h"
#include "tufted/normals.h"

// Oriented normals, for the subcommands that need to know which side of the surface is in front.

/// Options of orientedFrames().
struct Orienting {
  bool consistent = false;  ///< whether the sensor's position is left out of account
};

/// Adds --consistent.
void addOrienting(CLI::App& command, Orienting& orienting);

/// @throws IoError for a folder without what orientedFrames() needs
void checkFrames(const Operator& source);

/// @throws IoError for a folder without measured_positions.npy
void checkPositions(const Operator& source);

/// The frames of a cloud as they are, or those of a mesh's triangles.
tufted::Frames framesOf(const Operator& source);

/// Frames that face the sensor, if its position is known and they may, else consistent ones. Says in the results which.
tufted::Frames orientedFrames(const Orienting& orienting, const Operator& source, Results& results);
