#pragma once

#include "cover/edge_lengths.h"
#include "direct/cover_near_flips.h"
#include "direct/star_metric.h"
#include "stars/stars.h"

namespace tufted {

/// A union of stars glued with Gluing::star, after flips. Borrowed.
struct GluedStars {
  const Stars& stars;
  const Buffer<std::uint8_t>& disagrees;  ///< see findDisagreement()
  const StarMetric& metric;
  const EdgeLengths& length;
  CoverNearFlips& cover;
};

}  // namespace tufted
