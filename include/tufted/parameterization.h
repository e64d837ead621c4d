#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "tufted/laplacian.h"
#include "tufted/solver.h"
#include "tufted/types.h"

namespace tufted {

/// How a surface is laid out in the plane.
enum class ParameterizationMethod : std::uint8_t {
  conformal,  ///< angles are kept as well as can be; the rim is free (Mullen et al. 2008)
  harmonic,   ///< the rim is given, or a circle; each point inside is a mean of its neighbours (Tutte 1963)
};

/// Whose means the points of a harmonic parameterisation are.
enum class HarmonicWeights : std::uint8_t {
  laplacian,   ///< those of L, which are positive: no edge of L's own triangulation crosses another
  mean_value,  ///< mean value weights on the edges of the triangles: no triangle is flipped (Floater 2003)
};

/// Options of parameterize().
struct ParameterizationOptions {
  ParameterizationMethod method = ParameterizationMethod::conformal;  ///< how the surface is laid out
  HarmonicWeights weights = HarmonicWeights::laplacian;               ///< of ParameterizationMethod::harmonic
  /// Of ParameterizationMethod::harmonic: the points of the rim in order, at least three, which are then not taken from
  /// the triangles. The caller answers for it that the surface within is a disk.
  std::vector<int> rim = {};
  /// R x 2 positions of `rim`, in any unit; 0 rows: on the circle of radius 1 about 0, spaced as along the rim.
  Eigen::MatrixX2d rim_positions = {};
  SolverOptions solver = {};  ///< how systems are solved
};

/// What parameterize() did. A chart is a set of triangles that edges join.
struct ParameterizationReport {
  std::int64_t charts = 0;            ///< that were laid out
  std::int64_t closed = 0;            ///< charts without a rim, which no plane can hold
  std::int64_t nonorientable = 0;     ///< charts without two sides
  std::int64_t collapsed_charts = 0;  ///< charts of which a conformal map collapses more than a thousandth of the area
  std::int64_t cut = 0;               ///< triangles of a cloud left out, as orientations met there that did not agree
  std::int64_t nonmanifold = 0;       ///< charts with an edge of more than two triangles
  std::int64_t shared_points = 0;     ///< points of several charts that were laid out; they lie in the largest one
  std::int64_t not_mapped = 0;        ///< points that are NaN: in no chart that was laid out, or taking no part
  std::int64_t rims = 0;              ///< closed curves in which charts end
  std::int64_t triangles = 0;         ///< of charts that were laid out, without those that a shared point takes part in
  std::int64_t flipped = 0;           ///< of these, those whose area in the plane is not positive
  /// How many of `triangles` are lower in the plane than 1e-7 of the map's extent but not so on the surface, as at the
  /// end of long tubes, where the scale falls by a factor of e within each radius of the tube. They are not among
  /// `flipped`.
  std::int64_t collapsed = 0;
  /// Mean over the triangles that are neither flipped nor collapsed, weighted by their area on the surface, of the
  /// ratio of the singular values of the map: 1 where angles are kept.
  double quasi_conformal_error = 1;
  int iterations = 0;         ///< the most of any chart: of the eigenvector, or of a system
  double residual = 0;        ///< the greatest of any chart: of the eigenvector, relative, or of a system
  std::string solver_method;  ///< as SolverReport::method
  double seconds = 0;         ///< wall-clock
};

/// Lays a surface out in the plane.
///
/// Conformal (Mullen, Tong, Alliez, Desbrun: "Spectral conformal parameterization", 2008): each chart has the map of
/// the least conformal energy E among those of one size of the rim: the complex eigenvector z of L_C z = lambda B z
/// with the least eigenvalue but that of constants. L_C = L_D - A, of which L_D gives the Dirichlet energy and A the
/// area in the plane, both of the same oriented triangles, so that E = z* L_C z / 2 >= 0 (Sharp and Crane 2020, Figure
/// 20). B holds at each point of the rim half the length of its two edges. Any number of rims. A chart has the area
/// that its triangles have, in the caller's unit; charts lie beside each other, the first at the origin, longer side
/// along u.
///
/// Harmonic: one chart that is a disk, of which one simple rim is pinned, and each other point is a mean of its
/// neighbours. With the weights of L that holds for all points of L's component, also without triangles.
///
/// The triangles of a cloud are cut where orientations meet that do not agree, as single wrong ones make them do on
/// scans; a mesh with one side is refused. Triangles are oriented as the largest number of those given; turning all of
/// them mirrors the result.
/// @param laplacian with its positions
/// @param triangles F x 3: those of the mesh, or surfaceTriangles() of a cloud. Those that name a point twice, or one
/// that is not active, are left out.
/// @return N x 2; NaN at points that are isolated or not finite or lie in no chart that was laid out; a coincident
///         point has its representative's position
/// @throws InvalidInput for arrays of the wrong size, indices out of range, positions that are not finite; where there
///         is no triangle; where the largest chart is closed, nonorientable or not a manifold; for conformal also where
///         more than a thousandth of its area collapses; for harmonic also where there are several charts, several
///         rims, a rim that passes a point twice or a handle, and for a given rim with fewer than three points, a point
///         twice, one not active, or points of several components
/// @throws SolverFailure when a system cannot be solved, or the eigenvector does not converge
/// @throws Cancelled when `options.solver.progress` returns false
Eigen::MatrixX2d parameterize(const Laplacian& laplacian, const TrianglesRef& triangles,
                              const ParameterizationOptions& options = {}, ParameterizationReport* report = nullptr);

}  // namespace tufted
