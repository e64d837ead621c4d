#pragma once

#include "base/buffer.h"
#include "cloud/morton.h"
#include "cloud/stars.h"
#include "intrinsic/star_areas.h"
#include "operators/pipeline.h"
#include "tufted/laplacian.h"

namespace tufted {

/// Algorithm 3 on the union of stars glued with Gluing::star, from the stars themselves where they agree. Keeps what
/// the cover is made of, if asked to, and books its stages.
/// @returns ownAreas() with Mass::star, else nothing
OwnAreas finishFromStars(Stars stars, RankedCloud cloud, const CloudOptions& options, const Workers& workers,
                               StageClock& clock, Laplacian& result);

}  // namespace tufted
