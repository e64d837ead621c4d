#pragma once

#include <cstdint>

#include "base/buffer.h"
#include "base/parallel.h"
#include "intrinsic/partial_cover.h"
#include "intrinsic/star_metric.h"
#include "operators/assemble.h"

namespace tufted {

/// assembleLaplacian() for a union of stars glued with Gluing::star, after flips: the same up to rounding.
///
/// An edge with an agreeing end that no flip came near has the same two angles opposite it in all its six copies, so
/// that its weight is read off one star. Only edges between two other points are summed over the faces of the cover.
/// @param side_length of the sides of the faces that are present; whatever the cover itself says
/// @param scale of one face, see finishLaplacian()
void assembleStars(const Stars& stars, const StarMetric& metric, const PartialCover& cover, Buffer<double> side_length,
                   const EdgeLengths& length, const Buffer<int>& caller, int size, double scale, const Workers& workers,
                   Laplacian& result);

}  // namespace tufted
