#pragma once

#include <cstdint>

#include "base/buffer.h"
#include "base/parallel.h"
#include "cover/edge_lengths.h"
#include "direct/radial_cycles.h"
#include "direct/star_metric.h"

namespace tufted {

/// A side at an edge that is not Delaunay, possibly within rounding: its plus copy, its minus copy or both. The plus
/// copy runs from the smaller to the larger vertex.
struct FlipSeed {
  StarSide side;
  bool is_plus, is_minus;
};

/// The edges with which Algorithm 2 begins on a union of stars, by blocks of stars (section 11 of docs/algorithm.md).
Buffer<Buffer<FlipSeed>> findFlipSeeds(const Stars& stars, const EdgeLengths& length, const RadialCycles& cycles,
                                       const StarMetric& metric, std::int64_t block_size, const Workers& workers);

}  // namespace tufted
