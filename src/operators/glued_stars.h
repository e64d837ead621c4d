#pragma once

#include "cloud/stars.h"
#include "intrinsic/edge_lengths.h"
#include "intrinsic/partial_cover.h"
#include "intrinsic/star_metric.h"

namespace tufted {

/// A union of stars glued with Gluing::star, after flips. Borrowed.
struct GluedStars {
  const Stars& stars;
  const StarMetric& metric;
  const EdgeLengths& length;
  PartialCover& cover;
};

}  // namespace tufted
