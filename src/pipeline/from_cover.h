#pragma once

#include <memory>

#include "base/buffer.h"
#include "base/cover_source.h"
#include "base/parallel.h"
#include "base/point_buffer.h"
#include "base/stage_clock.h"
#include "tufted/laplacian.h"

namespace tufted {

/// The positions of a cover's vertices, and their numbers in the input.
struct CoverVertices {
  const PointsView& points;        ///< by vertex, in units of 2^exponent of the caller's
  const Buffer<int>& input_index;  ///< the caller's index of each vertex
  int exponent;
};

/// Algorithm 3 of the paper from the glued cover on: lengths and mollification (step 10 of docs/algorithm.md), flips
/// (Algorithm 2), L and M.
/// @param delta least length of an edge, relative to the longest side of the smaller of its two faces
/// @param keep_cover whether the result keeps the cover, in the caller's numbering and unit
void finishFromCover(std::shared_ptr<StoredCover> stored, const CoverVertices& vertices, double delta, bool keep_cover,
                     const Workers& workers, StageClock& clock, Laplacian& result);

}  // namespace tufted
