#pragma once

#include "base/buffer.h"
#include "base/parallel.h"
#include "base/point_buffer.h"
#include "stars/stars.h"
#include "tufted/report.h"

namespace tufted {

/// Drops triangles that are too large for the sampling, see Filter and section 7 of docs/algorithm.md. A point that
/// loses a triangle is flagged in `ends`.
/// @param points n x 3, by rank
void filterStars(BuiltStars& built, const PointsView& points, Filter filter, const Workers& workers, Report& report);

/// Counts distinct triangles with 1, 2 and 3 votes, in Report::votes.
/// @param disagrees see findDisagreement(): triangles of points that agree have 3 votes
void countVotes(const Stars& stars, const Buffer<std::uint8_t>& disagrees, const Workers& workers, Report& report);

}  // namespace tufted
