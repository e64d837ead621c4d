#pragma once

#include <vector>

#include "base/parallel.h"
#include "tufted/intrinsic_triangulation.h"
#include "tufted/report.h"
#include "tufted/types.h"

namespace tufted {

/// Negative weights up to this share of the larger diagonal are rounding.
constexpr double weight_rounding = 1e-9;

/// L and M in the caller's numbering.
struct Matrices {
  SparseMatrix L;  ///< N x N, see Laplacian
  VectorXd M;      ///< N, in units of the cover's length squared
};

/// Cotan Laplacian and lumped areas of a cover (Algorithm 3, lines 6 to 15), times `scale`.
///
/// Sums run in the cover's own numbering, so they do not depend on the caller's. The diagonal is minus the sum of the
/// other entries. Negative weights are set to 0: those within 1e-9 of the larger diagonal are rounding, others are
/// counted as failures in the report.
/// @param cover vertices in [0, n)
/// @param caller n, the caller's index of each vertex
/// @param size N
Matrices assembleLaplacian(const IntrinsicTriangulation& cover, const std::vector<int>& caller, int size, double scale,
                           const Workers& workers, Report& report);

/// Connected components of the graph of L among rows with a positive diagonal.
std::int64_t countComponents(const SparseMatrix& L);

}  // namespace tufted
