#pragma once

#include "direct/edge_lengths.h"
#include "direct/partial_cover.h"
#include "direct/star_metric.h"
#include "stars/stars.h"

namespace tufted {

/// A union of stars glued with Gluing::star, after flips. Borrowed.
struct GluedStars {
  const Stars& stars;
  const StarMetric& metric;
  const EdgeLengths& length;
  PartialCover& cover;
};

}  // namespace tufted
