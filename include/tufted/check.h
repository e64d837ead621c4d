#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tufted/intrinsic_triangulation.h"
#include "tufted/laplacian.h"

namespace tufted {

/// L, M and cover_areas against what the faces of the cover say: L is assembled once more, corner by corner.
///
/// Where the cover is a cloud's that was built from stars, masses are compared with the areas of these; on meshes and
/// with Mass::cover with the cover's. Masses of stars that are not there any more, as with other gluings and after
/// reading from files, leave nothing to compare each with: there the sum of M must lie within what areas of stars can
/// be, between 3/40 of and 30 times that of the cover without Report::mollify_area.
struct SurfaceCheck {
  double weight_error = 0;         ///< greatest |L_ij - L'_ij| over the larger diagonal of L' at i and j
  double area_error = 0;           ///< greatest relative error of cover_areas, 0 where these are not known
  double mass_error = 0;           ///< greatest relative error of M, 0 where `masses_compared` is false
  bool masses_compared = false;    ///< each mass was compared with the area it must be
  std::int64_t coarse_points = 0;  ///< not compared: lengths at them are below 1e-292, where doubles have fewer digits
};

/// What `validate` measures on L, M, status and the cover themselves. Only the edges that were given up, and without a
/// cover the clamped weights, leave no trace there; for those the report is asked.
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

  std::optional<CoverCheck> cover;      ///< where the cover is kept
  std::optional<SurfaceCheck> surface;  ///< the same, and the cover is whole
  /// A sentence per thing that could not be looked at, with its reason. Empty when everything was.
  std::vector<std::string> not_checked;

  /// A sentence per broken promise: which, how often, and where first. Empty when all hold.
  std::vector<std::string> faults;

  bool ok() const { return faults.empty(); }
};

/// Checks what a Laplacian promises. Takes the memory of L once more, and then that of its Cholesky factor; the cover
/// of a cloud is built if it was not yet.
///
/// L must be symmetric bit for bit, its off-diagonals must not be positive at all, and its rows must sum to 0 within
/// the rounding of their own sum. The factorisation is that of D^-1/2 L D^-1/2 + 1e-12, D = diag(L): each weight is
/// judged against its own diagonals, and the shift exceeds the rounding.
/// Each entry of L must be that of the cover's faces within 1e-11 of the larger diagonal of its row and column, and
/// each area and mass within 1e-11 of itself; see SurfaceCheck.
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
