#pragma once

#include "base/buffer.h"
#include "base/parallel.h"
#include "tufted/intrinsic_triangulation.h"
#include "tufted/laplacian.h"
#include "tufted/types.h"

namespace tufted {

/// Cotan Laplacian and lumped areas of a cover (Algorithm 3, lines 6 to 15; section 12 of docs/algorithm.md), times
/// `scale`.
///
/// Sums run in the cover's own numbering, so they do not depend on the caller's. The diagonal is minus the sum of the
/// other entries. Negative weights are set to 0: those within 1e-9 of the larger diagonal are rounding, others are
/// counted as failures in the report.
/// @param[out] result L, M, components and their part of the report, in units of the cover's length; reuses memory
/// @param cover vertices in [0, n)
/// @param input_index n, the caller's index of each vertex
/// @param size N of the caller
void assembleLaplacian(const IntrinsicTriangulation& cover, const Buffer<int>& input_index, int size, double scale,
                       const Workers& workers, Laplacian& result);

}  // namespace tufted
