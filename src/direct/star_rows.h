#pragma once

#include <cstdint>

#include "base/buffer.h"
#include "base/parallel.h"
#include "cover/assemble.h"
#include "direct/glued_stars.h"

namespace tufted {

/// assembleLaplacian() for glued stars: the same up to rounding.
///
/// An edge with an agreeing end that no flip came near has the same two angles opposite it in all its six copies, so
/// that its weight is read off one star. Only edges between two other points are summed over the faces of the cover.
/// @param keep_cover whether the cover is needed afterwards
/// @param scale of one face, see faceScale()
void assembleStars(const GluedStars& glued, bool keep_cover, const Buffer<int>& input_index, int size, double scale,
                   const Workers& workers, Laplacian& result);

}  // namespace tufted
