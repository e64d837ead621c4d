#pragma once

#include "base/buffer.h"
#include "base/parallel.h"
#include "base/point_buffer.h"
#include "stars/stars.h"
#include "tufted/report.h"

namespace tufted {

/// Drops triangles that no surface sampled like this would have, see Filter. A point that loses a triangle is tagged in
/// `ends`.
/// @param points n x 3, by rank
void filterStars(BuiltStars& built, const PointsView& points, Filter filter, const Workers& workers, Report& report);

/// Counts the distinct triangles that 1, 2 and 3 of their corners' stars contain.
/// @param disagrees see findDisagreement(): all corners' stars contain the triangles of the others
void countVotes(const Stars& stars, const Buffer<std::uint8_t>& disagrees, const Workers& workers, Report& report);

}  // namespace tufted
