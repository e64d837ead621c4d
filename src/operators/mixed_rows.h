#pragma once

#include <cstdint>

#include "base/buffer.h"
#include "base/parallel.h"
#include "operators/glued_stars.h"
#include "operators/rows.h"
#include "tufted/report.h"

namespace tufted {

/// What the faces of the cover add to the weights of edges between mixed points, filed under the smaller of the two,
/// and a third of each face's area to each mixed corner (Section 3.3). Everything in an order that ranks decide.
/// @param mixed n, 1 for a mixed point
/// @param scale of one face, see finishLaplacian()
/// @param mass n, is added to
/// @param report degenerate_faces counts faces without area at a mixed point
Rows collectTerms(const GluedStars& glued, const Buffer<std::uint8_t>& mixed, double scale, RawBuffer<double>& mass,
                  const Workers& workers, Report& report);

/// The terms of each edge, in their order, summed, and filed under both of its points.
Rows mergeTerms(Rows terms, const Workers& workers);

}  // namespace tufted
