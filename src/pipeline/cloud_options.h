#pragma once

#include "tufted/options.h"
#include "tufted/types.h"

namespace tufted {

/// Checks the options of a build of a cloud.
/// @throws InvalidInput, naming `function`, for options out of range and arrays that do not fit the points
void checkCloudOptions(const char* function, const PointsRef& points, const CloudOptions& options);

}  // namespace tufted
