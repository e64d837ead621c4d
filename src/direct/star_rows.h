#pragma once

#include <cstdint>

#include "base/buffer.h"
#include "base/parallel.h"
#include "cover/assemble.h"
#include "direct/glued_stars.h"

namespace tufted {

/// assembleLaplacian() for glued stars, with the same result up to rounding.
///
/// An edge with an end that agrees and that no flip came near has the same two opposite angles in all its six copies,
/// so that its weight is read off one star. Only edges between other points, the mixed ones, are summed over faces of
/// the cover.
/// @param keep_cover whether the faces of the cover are needed later
/// @param scale see faceScale()
void assembleStars(const GluedStars& glued, bool keep_cover, const Buffer<int>& input_index, int size, double scale,
                   const Workers& workers, Laplacian& result);

}  // namespace tufted
