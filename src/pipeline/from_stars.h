#pragma once

#include "base/parallel.h"
#include "base/stage_clock.h"
#include "neighbors/morton.h"
#include "stars/surface_stars.h"
#include "tufted/laplacian.h"
#include "tufted/options.h"

namespace tufted {

/// Algorithms 1 to 3 straight from the stars, see direct/star_union.h: the same result as finishFromCover() up to
/// rounding, in half the time. The result keeps what the cover is made of, if the options say so.
/// @returns false, with nothing of use, where a triangle is flat, or flips make one flat or do not end, and edges may
/// be lengthened: only finishFromCover() does that
bool finishFromStars(SurfaceStars built, RankedCloud cloud, const CloudOptions& options, const Workers& workers,
                     StageClock& clock, Laplacian& result);

}  // namespace tufted
