#pragma once

#include "base/scaling.h"
#include "tufted/tiles.h"

namespace tufted {

/// measureScaling() of points that are read in passes, in little memory: the same numbers.
Scaling measureScaling(const PointSource& source);

/// Whether a point takes part, as measureScaling() decides.
bool takesPart(const Scaling& scaling, const Eigen::RowVector3d& point);

}  // namespace tufted
