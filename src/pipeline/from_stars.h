#pragma once

#include <optional>

#include "base/parallel.h"
#include "base/stage_clock.h"
#include "direct/star_areas.h"
#include "neighbors/morton.h"
#include "stars/surface_stars.h"
#include "tufted/laplacian.h"
#include "tufted/options.h"

namespace tufted {

/// Algorithms 1 to 3 straight from the stars, see direct/star_union.h: the same result as finishFromCover() up to
/// rounding, in half the time. The result keeps what the cover is made of, if the options say so.
/// @returns ownAreas() with Mass::star, else empty ones. Nothing where a triangle is flat, or flips make one flat or do
/// not end, and edges may be lengthened: only finishFromCover() does that.
std::optional<OwnAreas> finishFromStars(SurfaceStars built, RankedCloud cloud, const CloudOptions& options,
                                        const Workers& workers, StageClock& clock, Laplacian& result);

}  // namespace tufted
