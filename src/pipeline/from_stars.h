#pragma once

#include "base/parallel.h"
#include "base/stage_clock.h"
#include "neighbors/morton.h"
#include "stars/surface_stars.h"
#include "tufted/laplacian.h"
#include "tufted/options.h"

namespace tufted {

/// Algorithms 1 to 3 straight from the stars, see direct/star_union.h: the same result as finishFromCover() up to
/// rounding, in half the time. The result keeps the stars for its cover if the options say so.
/// @returns false, with a meaningless result, if edges may be lengthened and a triangle is flat, or flips make one flat
/// or do not end: finishFromCover() handles these
bool finishFromStars(SurfaceStars built, RankedCloud cloud, const CloudOptions& options, const Workers& workers,
                     StageClock& clock, Laplacian& result);

}  // namespace tufted
