#pragma once

#include "operator.h"
#include "options.h"
#include "tufted/errors.h"

// Results that are new places of the points.

/// The triangles of a mesh, or those found on a cloud.
/// @throws IoError for the Laplacian of a mesh without its triangles
tufted::Triangles trianglesOf(const Operator& source);

/// Runs `work`, whose arguments were checked: what it still refuses is the surface's fault.
/// @throws IoError in place of InvalidInput
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

/// Takes `positions` for the points that are written and looked at; shown is how far each has moved, and the report
/// says the farthest and the mean way.
/// @param name of the array in the results
void movePoints(const std::string& name, const Eigen::MatrixXd& positions, Operator& source, Results& results);
