#pragma once

#include "base/parallel.h"
#include "cloud/stars.h"
#include "tufted/report.h"

namespace tufted {

/// Drops triangles that no surface sampled like this would have: circumradius R > r_k(p), which are slivers along a
/// rim, or R > 4 times the smallest r_k of the three corners, which are bridges to outliers. A cloud of no more than
/// k + 1 points keeps all but the flat ones. A point that loses a triangle is tagged in `ends`.
void filterStars(Stars& stars, int k, const Workers& workers, Report& report);

/// Counts the distinct triangles that 1, 2 and 3 of their corners' stars contain.
void countVotes(const Stars& stars, const Workers& workers, Report& report);

}  // namespace tufted
