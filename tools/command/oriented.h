#pragma once

#include <CLI/App.hpp>

#include "operator.h"
#include "tufted/normals.h"

// Oriented normals, for subcommands that need normals of one sign.

/// Options of orientedFrames().
struct Orienting {
  bool consistent = false;  ///< whether to ignore the sensor's position
};

/// Adds --consistent.
void addOrienting(CLI::App& command, Orienting& orienting);

/// @throws IoError for a folder without what orientedFrames() needs
void checkFrames(const Operator& source);

/// @throws IoError for a folder without measured_positions.npy
void checkPositions(const Operator& source);

/// The frames of a cloud's Laplacian, or meshFrames() of a mesh.
tufted::Frames framesOf(const Operator& source);

/// Frames that face the sensor if its position is known and not ignored, otherwise consistent ones. Notes which in the
/// results.
tufted::Frames orientedFrames(const Orienting& orienting, const Operator& source, Results& results);
