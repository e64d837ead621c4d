#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "algorithms/vector_heat.h"
#include "tufted/laplacian.h"

// Checks and projections of the sources of the vector heat method.

namespace tufted {

/// Checks values at sources, one row per source.
/// @param what name of `values` in errors
/// @throws InvalidInput for no source, another number of rows, or values that are not finite
void checkSources(const char* function, const std::vector<int>& sources, const char* what,
                  const Eigen::Ref<const Eigen::MatrixXd>& values);

/// Checks that heat starts somewhere.
/// @param start heat at the sources that are not ignored
/// @throws InvalidInput if all sources are ignored
void checkHeat(const char* function, const FieldHeat& heat, const std::vector<int>& sources, const HeatFields& start);

/// The coordinates of a vector's projection into the tangent plane of a point.
/// @param name of the vector, for errors
/// @throws InvalidInput for a vector other than 0 that is perpendicular to the plane
Eigen::Vector2d inTangentPlane(const std::string& name, const Frames& frames, int point,
                               const Eigen::RowVector3d& vector);

}  // namespace tufted
