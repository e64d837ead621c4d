#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tufted/intrinsic_triangulation.h"
#include "tufted/laplacian.h"
#include "tufted/options.h"

namespace tufted {

/// Differences between L, M and cover_areas and the values that are assembled anew from the faces of the cover, corner
/// by corner (Sharp and Crane 2020, Algorithm 3).
///
/// Masses are compared with areas of the cover or, with Mass::star where the surface of a cloud ends, with areas of
/// stars. Where these stars no longer exist, as with other gluings and after reading from files, masses are not
/// compared.
struct SurfaceCheck {
  double weight_error = 0;         ///< greatest |L_ij - L'_ij| over the larger diagonal at i and j of L', the new L
  double area_error = 0;           ///< greatest relative error of cover_areas; 0 if these are not stored
  double mass_error = 0;           ///< greatest relative error of M
  bool masses_compared = false;    ///< whether every mass was compared
  std::int64_t coarse_points = 0;  ///< points not compared, with lengths below 1e-292, where doubles have fewer digits
};

/// Measurements of `validate` on L, M, status and the cover. Flips that were given up, and without a cover clamped
/// weights, cannot be measured; their counts are those of the report.
struct LaplacianCheck {
  std::array<std::int64_t, 4> status = {};  ///< number of points with each PointStatus
  std::int64_t components = 0;              ///< connected components of the points with a row
  double nonzeros_per_row = 0;              ///< stored entries of L over the number of active points

  std::int64_t positive_off_diagonals = 0;  ///< off-diagonal entries of L that are positive
  std::int64_t not_finite = 0;              ///< entries of L and of M that are not finite
  std::int64_t not_positive_diagonals = 0;  ///< active points whose diagonal in L is not positive
  std::int64_t negative_masses = 0;         ///< entries of M that are negative
  std::int64_t zero_masses = 0;        ///< active points of mass 0; no fault: areas of lengths below 1e-154 underflow
  std::int64_t inactive_not_zero = 0;  ///< nonzero entries of L and of M at points that are not active
  double symmetry_error = 0;           ///< greatest |L_ij - L_ji| over the larger diagonal of i and j
  double row_sum_error = 0;            ///< greatest |sum of row i| over L_ii of active points
  bool definite = false;               ///< whether L + 1e-12 diag(L) of the active points has a Cholesky factor

  std::optional<CoverCheck> cover;      ///< set if there is a cover
  std::optional<SurfaceCheck> surface;  ///< set if there is a cover and its sides and corners are valid
  /// One sentence for each check that could not be made, with the reason. Empty if all were made.
  std::vector<std::string> not_checked;

  /// One sentence for each broken promise: which, how often, and where first. Empty if all hold.
  std::vector<std::string> faults;

  /// Whether all promises hold.
  bool ok() const { return faults.empty(); }
};

/// Checks what a Laplacian promises. Takes the memory of L once more, then that of its Cholesky factor; builds the
/// cover of a cloud if it is not yet built.
///
/// L must be symmetric bit for bit, its off-diagonals must not be positive at all, and its rows must sum to 0 within
/// the rounding of their own sum. The matrix factorised is D^-1/2 L D^-1/2 + 1e-12, D = diag(L): each weight is
/// compared with its own diagonals, and the shift exceeds the rounding. Every entry of L must equal the one assembled
/// from the faces of the cover to within 1e-11 of the larger diagonal of its row and column, every area and mass to
/// within 1e-11 of itself; see SurfaceCheck. Representatives, frames, positions and the counts of the report are
/// checked too. Wrong values in the arrays are reported and do not throw. If array sizes or indices of L are wrong,
/// nothing else is checked and all figures stay at 0.
/// @param progress called between the checks, of which the factorisation, and a cover yet to be built, take longest
/// @throws Cancelled when `progress` returns false
LaplacianCheck validate(const Laplacian& laplacian, const Progress& progress = {});

/// Checks the array sizes of a Laplacian, which may have been assembled by hand, in O(N). Functions that take a
/// Laplacian call it first. For N points L is N x N; M, status, representative and boundary have N entries; component,
/// cover_areas, frames, positions and noise N or none; a stored cover has N vertices; and every representative lies in
/// [0, N) and is its own representative.
/// @param function name of the caller, for the message
/// @throws InvalidInput naming the member, its size or value, and the rule
void checkSizes(const std::string& function, const Laplacian& laplacian);

}  // namespace tufted
