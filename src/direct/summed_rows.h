#pragma once

#include <cstdint>

#include "base/buffer.h"
#include "base/parallel.h"
#include "cover/rows.h"
#include "direct/glued_stars.h"
#include "tufted/report.h"

namespace tufted {

/// Weights of edges between mixed points, summed over the faces of the cover and stored at both ends; adds to the mass
/// of each mixed point a third of the area of each face at it (Section 3.3). Sums run in an order that depends only on
/// ranks.
/// @param mixed n, 1 for a mixed point, see assembleStars()
/// @param keep_cover if false, faces are dropped once they are read
/// @param scale see faceScale()
/// @param[in,out] mass n
/// @param report degenerate_faces counts faces without area at a mixed point
Rows summedRows(const GluedStars& glued, const Buffer<std::uint8_t>& mixed, bool keep_cover, double scale,
                RawBuffer<double>& mass, const Workers& workers, Report& report);

}  // namespace tufted
