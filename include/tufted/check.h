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

/// Errors of L, M and cover_areas against values recomputed from the faces of the cover; L is assembled once more,
/// corner by corner.
///
/// Masses are compared with the areas of the cover, and with Mass::star, where the surface of a cloud ends, with the
/// areas of the stars. If the stars no longer exist, as with other gluings and after reading from files, masses there
/// are not compared.
struct SurfaceCheck {
  double weight_error = 0;         ///< greatest |L_ij - L'_ij| over the larger diagonal of L' at i and j
  double area_error = 0;           ///< greatest relative error of cover_areas, 0 where these are not known
  double mass_error = 0;           ///< greatest relative error of M
  bool masses_compared = false;    ///< each mass was compared with the area it must be
  std::int64_t coarse_points = 0;  ///< points not compared, for lengths below 1e-292, where doubles have fewer digits
};

/// What `validate` measures on L, M, status and the cover. Edges that were given up, and without a cover the clamped
/// weights, leave no trace there; their counts are taken from the report.
struct LaplacianCheck {
  std::array<std::int64_t, 4> status = {};  ///< number of points, by PointStatus
  std::int64_t components = 0;              ///< connected components among points with a row
  double nonzeros_per_row = 0;              ///< stored entries of L over the number of active points

  std::int64_t positive_off_diagonals = 0;  ///< entries of L
  std::int64_t not_finite = 0;              ///< entries of L and of M that are not finite
  std::int64_t not_positive_diagonals = 0;  ///< active points whose diagonal in L is not positive
  std::int64_t negative_masses = 0;         ///< entries of M
  std::int64_t zero_masses = 0;        ///< active points of mass 0; no fault: areas of lengths below 1e-154 underflow
  std::int64_t inactive_not_zero = 0;  ///< entries of L and of M that belong to a point that is not active
  double symmetry_error = 0;           ///< greatest |L_ij - L_ji| over the larger diagonal of i and j
  double row_sum_error = 0;            ///< greatest |sum of row i| over L_ii of active points
  bool definite = false;               ///< L + 1e-12 diag(L) of the active points has a Cholesky factor

  std::optional<CoverCheck> cover;      ///< set if the cover is kept
  std::optional<SurfaceCheck> surface;  ///< set if the cover is kept and whole
  /// One sentence for each check that could not be made, with the reason. Empty if all were made.
  std::vector<std::string> not_checked;

  /// One sentence for each broken promise: which, how often, and where first. Empty if all hold.
  std::vector<std::string> faults;

  /// Whether all promises hold.
  bool ok() const { return faults.empty(); }
};

/// Checks what a Laplacian promises. Takes the memory of L once more, and then that of its Cholesky factor; the cover
/// of a cloud is built if it was not yet.
///
/// L must be symmetric bit for bit, its off-diagonals must not be positive at all, and its rows must sum to 0 within
/// the rounding of their own sum. The factorisation is that of D^-1/2 L D^-1/2 + 1e-12, D = diag(L): each weight is
/// judged against its own diagonals, and the shift exceeds the rounding.
/// Every entry of L must equal that of the cover's faces to within 1e-11 of the larger diagonal of its row and column,
/// and every area and mass to within 1e-11 of itself; see SurfaceCheck.
/// Wrong values in the arrays are reported and do not throw. If array sizes or indices of L are wrong, the other
/// figures stay at zero.
/// @param progress called between the checks; the longest of them are the factorisation, and the cover where it is yet
///        to be built
/// @throws Cancelled when `progress` returns false
LaplacianCheck validate(const Laplacian& laplacian, const Progress& progress = {});

/// Checks the sizes of a Laplacian's members, which may have been put together by hand; every function that takes a
/// Laplacian does so first. For N points L is N x N; M, status, representative and boundary have N entries, cover_areas
/// and frames N or none; a cover has N vertices if it is stored; and every representative lies in [0, N) and is its own
/// representative. O(N).
/// @param function name of the caller, for the message
/// @throws InvalidInput naming the member, its size or value, and the rule
void checkSizes(const std::string& function, const Laplacian& laplacian);

}  // namespace tufted
