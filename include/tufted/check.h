#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tufted/intrinsic_triangulation.h"
#include "tufted/laplacian.h"

namespace tufted {

/// What `validate` measures on L, M, status and the cover themselves. Only the clamped weights and the edges that were
/// given up leave no trace there; for those the report is asked.
struct LaplacianCheck {
  std::array<std::int64_t, 4> status = {};  ///< number of points, by PointStatus
  std::int64_t components = 0;              ///< connected components among points with a row
  double nonzeros_per_row = 0;              ///< stored entries of L over active points

  std::int64_t positive_off_diagonals = 0;
  std::int64_t not_finite = 0;              ///< entries of L and of M
  std::int64_t not_positive_diagonals = 0;  ///< of active points
  std::int64_t negative_masses = 0;
  std::int64_t zero_masses = 0;        ///< of active points; no fault, areas of lengths below 1e-154 underflow
  std::int64_t inactive_not_zero = 0;  ///< entries of L and of M that belong to a point that is not active
  double symmetry_error = 0;           ///< greatest |L_ij - L_ji| over the larger diagonal of i and j
  double row_sum_error = 0;            ///< greatest |sum of row i| over L_ii, active points
  bool definite = false;               ///< L + 1e-12 diag(L) of the active points has a Cholesky factor

  std::optional<CoverCheck> cover;  ///< where the cover is kept

  /// A sentence per broken promise: which, how often, and where first. Empty when all hold.
  std::vector<std::string> faults;

  bool ok() const { return faults.empty(); }
};

/// Checks what a Laplacian promises. Takes the memory of L once more, and then that of its Cholesky factor.
///
/// L must be symmetric bit for bit, its off-diagonals must not be positive at all, and its rows must sum to 0 within
/// the rounding of their own sum. The factorisation is that of D^-1/2 L D^-1/2 + 1e-12, D = diag(L): each weight is
/// judged against its own diagonals, and the shift exceeds the rounding.
/// Whatever the arrays hold is reported and does not throw. The rest is left at zero where their sizes or the indices
/// of L are wrong.
LaplacianCheck validate(const Laplacian& laplacian);

/// What every function that takes a Laplacian asks for first, as its members may have been put together by hand: for N
/// points L is N x N; M, status, representative and boundary have N entries, cover_areas and frames N or none; a cover
/// has N vertices if it is stored; and every representative lies in [0, N) and is its own. O(N).
/// @param function to be named
/// @throws InvalidInput naming the member, its size or value, and the rule
void checkSizes(const std::string& function, const Laplacian& laplacian);

}  // namespace tufted
