#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "algorithms/vector_heat.h"
#include "tufted/laplacian.h"

// What queries of the vector heat method start from, checked.

namespace tufted {

/// @param what name of `values` in errors
/// @throws InvalidInput for no source, another number of rows, or values that are not finite
void checkSources(const char* function, const std::vector<int>& sources, const char* what,
                  const Eigen::Ref<const Eigen::MatrixXd>& values);

/// @param start what flows in at the sources, each of which has a place or is ignored
/// @throws InvalidInput where no source gives heat
void checkHeat(const char* function, const FieldHeat& heat, const std::vector<int>& sources, const HeatFields& start);

/// The coordinates of a vector's projection into the tangent plane of a point.
/// @param name of the vector, for errors
/// @throws InvalidInput for a vector that is not 0 and stands on the plane
Eigen::Vector2d inTangentPlane(const std::string& name, const Frames& frames, int point,
                               const Eigen::RowVector3d& vector);

}  // namespace tufted
