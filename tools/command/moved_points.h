#pragma once

#include "operator.h"
#include "options.h"
#include "tufted/errors.h"

// Results that are new positions of the points.

/// The triangles of a mesh, or surfaceTriangles() of a cloud.
/// @throws IoError for a folder of a mesh without its triangles
tufted::Triangles trianglesOf(const Operator& source);

/// trianglesOf() with coincident points replaced by their representatives.
tufted::Triangles joinedTriangles(const Operator& source);

/// Runs `work`, whose arguments were checked, so that InvalidInput is due to the surface.
/// @throws IoError instead of InvalidInput
template <class Work>
auto blameSurface(const Operator& source, const Work& work) {
  try {
    return work();
  } catch (const tufted::InvalidInput& error) {
    throw tufted::IoError(source.name + ": " + withoutClass(error.what()));
  }
}

/// @throws IoError for a folder without points.ply or points.pcd
void checkHasPoints(const Operator& source);

/// Replaces the points that are written and shown by `positions`. The field shown is how far each point moved; the
/// report has the greatest and the mean distance.
/// @param name name of the array of positions in the results
void movePoints(const std::string& name, const Eigen::MatrixXd& positions, Operator& source, Results& results);
