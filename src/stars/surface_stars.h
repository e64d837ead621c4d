#pragma once

#include "base/parallel.h"
#include "stars/stars.h"

namespace tufted {

/// The stars that the cover is made of: built, outliers isolated and filtered as the options say. Books every stage.
Stars surfaceStars(const RankedCloud& cloud, const NeighborSource& source, const CloudOptions& options,
                   const Workers& workers, Report& report);

}  // namespace tufted
