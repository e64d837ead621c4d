#pragma once

#include <cstdint>

#include "base/buffer.h"
#include "base/parallel.h"
#include "cover/rows.h"
#include "direct/glued_stars.h"
#include "tufted/report.h"

namespace tufted {

/// The weights of edges between mixed points, summed over the faces of the cover and filed under both ends, and to each
/// mixed point a third of the area of each face at it (Section 3.3). Sums run in an order that ranks decide.
/// @param mixed n, 1 for a mixed point
/// @param keep_cover false: its faces are dropped when they have been read
/// @param scale of one face, see faceScale()
/// @param mass n, is added to
/// @param report degenerate_faces counts faces without area at a mixed point
Rows summedRows(const GluedStars& glued, const Buffer<std::uint8_t>& mixed, bool keep_cover, double scale,
                RawBuffer<double>& mass, const Workers& workers, Report& report);

}  // namespace tufted
