#pragma once

#include <cstdint>

#include "base/buffer.h"
#include "base/parallel.h"
#include "intrinsic/partial_cover.h"
#include "intrinsic/star_metric.h"
#include "operators/assemble.h"

namespace tufted {

/// A union of stars glued with Gluing::star, after flips. Borrowed.
struct GluedStars {
  const Stars& stars;
  const StarMetric& metric;
  const PartialCover& cover;
  const EdgeLengths& length;
};

/// assembleLaplacian() for glued stars: the same up to rounding.
///
/// An edge with an agreeing end that no flip came near has the same two angles opposite it in all its six copies, so
/// that its weight is read off one star. Only edges between two other points are summed over the faces of the cover.
/// @param side_length three per face of the cover, which may have given them away; is overwritten
/// @param scale of one face, see finishLaplacian()
void assembleStars(const GluedStars& glued, Buffer<double> side_length, const Buffer<int>& caller, int size,
                   double scale, const Workers& workers, Laplacian& result);

}  // namespace tufted
