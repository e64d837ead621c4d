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
  conformal,  ///< angles are preserved as well as possible; the rim is free (Mullen et al. 2008)
  harmonic,   ///< the rim is given, or a circle; each inner point is a mean of its neighbours (Tutte 1963)
};

/// Weights of the means that the points of a harmonic parameterisation are.
enum class HarmonicWeights : std::uint8_t {
  laplacian,   ///< those of L, which are positive: no edge of L's own triangulation crosses another
  mean_value,  ///< mean value weights on the edges of the triangles: no triangle is flipped (Floater 2003)
};

/// Options of parameterize().
struct ParameterizationOptions {
  ParameterizationMethod method = ParameterizationMethod::conformal;  ///< how the surface is laid out
  HarmonicWeights weights = HarmonicWeights::laplacian;               ///< weights of the means, for harmonic
  /// For harmonic: indices of the points of the rim in order, at least three; empty: the rim of the triangles. With a
  /// given rim the caller must make sure that the surface inside it is a disk.
  std::vector<int> rim = {};
  /// R x 2 positions of `rim`, finite, in any unit; 0 rows: on the unit circle about 0, spaced as along the rim.
  Eigen::MatrixX2d rim_positions = {};
  SolverOptions solver = {};  ///< how systems are solved
};

/// Counts, accuracy and time of a call of parameterize(). A chart is a set of triangles connected by edges.
struct ParameterizationReport {
  std::int64_t charts = 0;            ///< charts that were laid out
  std::int64_t closed = 0;            ///< charts without a rim, which cannot be laid out
  std::int64_t nonorientable = 0;     ///< charts without two sides
  std::int64_t collapsed_charts = 0;  ///< charts of which a conformal map collapses more than a thousandth of the area
  std::int64_t cut = 0;               ///< triangles of a cloud left out because orientations disagreed there
  std::int64_t nonmanifold = 0;       ///< charts with an edge of more than two triangles
  std::int64_t shared_points = 0;     ///< points of several charts that were laid out; they lie in the largest one
  std::int64_t not_mapped = 0;        ///< points that are NaN: in no chart that was laid out, or taking no part
  std::int64_t rims = 0;              ///< rims of the charts that were laid out
  std::int64_t triangles = 0;         ///< triangles of charts that were laid out, without those at shared points
  std::int64_t flipped = 0;           ///< of `triangles`, those whose area in the plane is not positive
  /// A triangle counts as collapsed, and not in `flipped`, if its height in the plane, but not on the surface, is below
  /// 1e-7 of the extent. That happens at the ends of long tubes: the scale falls by a factor of e per radius of the
  /// tube.
  std::int64_t collapsed = 0;
  /// Mean over the triangles that are neither flipped nor collapsed, weighted by their area on the surface, of the
  /// ratio of the singular values of the map: 1 where angles are preserved.
  double quasi_conformal_error = 1;
  int iterations = 0;         ///< the most of any chart: of the eigenvector, or of a linear system
  double residual = 0;        ///< the greatest of any chart: relative, of the eigenvector, or of a linear system
  std::string solver_method;  ///< see SolverReport::method
  double seconds = 0;         ///< wall-clock
};

/// Lays a surface out in the plane.
///
/// Conformal (Mullen, Tong, Alliez, Desbrun: "Spectral conformal parameterization", 2008): each chart gets the map of
/// least conformal energy E among those with one size of the rim: the complex eigenvector z of L_C z = lambda B z with
/// the least eigenvalue other than that of constants. L_C = L_D - A, where L_D gives the Dirichlet energy and A the
/// area in the plane, both of the same oriented triangles, so E = z* L_C z / 2 >= 0 (Sharp and Crane 2020, Figure 20).
/// B holds at each point of the rim half the length of its two edges. A chart may have any number of rims. Its area is
/// that of its triangles; charts lie beside each other, the first at the origin, longer sides along u.
///
/// Harmonic: a single chart that is a disk. Its one simple rim is pinned, and each other point is a mean of its
/// neighbours; with the weights of L this includes points of L's component that are on no triangle.
///
/// Triangles of a cloud are cut apart where orientations disagree, as a few wrong ones may on scans; a mesh with one
/// side is refused. Triangles are oriented like most of those given; reversing all of them mirrors the result.
/// @param laplacian with its positions
/// @param triangles F x 3: those of the mesh, or surfaceTriangles() of a cloud. Triangles that repeat a point, or have
/// one that is not active, are left out.
/// @return N x 2; NaN at isolated and non-finite points and in no chart that was laid out; coincident points as their
/// representative
/// @throws InvalidInput for arrays of the wrong size, indices out of range, positions that are not finite, no triangle,
/// or a largest chart that is closed, nonorientable or not a manifold. Conformal: also for options of harmonic, or if
/// more than a thousandth of the area of that chart collapses. Harmonic: also for several charts (unless a rim is given
/// with the weights of L); without a given rim for several rims, a rim that passes a point twice, or a surface that is
/// not a disk; for a given rim with fewer than three points, a repeated or inactive point, one on no triangle
/// (mean_value), or points of several components
/// @throws SolverFailure when a system cannot be solved, or the eigenvector does not converge
/// @throws Cancelled when `options.solver.progress` returns false
Eigen::MatrixX2d parameterize(const Laplacian& laplacian, const TrianglesRef& triangles,
                              const ParameterizationOptions& options = {}, ParameterizationReport* report = nullptr);

/// Cuts a surface open along edges and lays it out, so that closed surfaces have a seam where the caller wants it.
///
/// The surface falls apart along the cuts, between all triangles of their edges. A point on a cut has a place for each
/// connected set of its triangles, so places are given for the corners of triangles, as the indices vt of an OBJ do.
/// @param cuts lists of points; consecutive ones are joined by edges of the triangles. Together they make disks of the
/// charts that they touch. A path within the surface needs at least two edges to open it.
/// @param options without a rim; with HarmonicWeights::mean_value if harmonic, as L has no cuts
/// @param report its points are those of the cut surface, where points on cuts count once for each of their places
/// @return 3 F x 2: row 3 t + s has the place of corner s of triangle t; NaN where parameterize() has NaN
/// @throws InvalidInput as parameterize(), and for a rim, harmonic weights of L, a cut of fewer than two points, a
/// point out of range, points that no edge joins, or a chart with a cut that is no disk
/// @throws SolverFailure and Cancelled as parameterize()
Eigen::MatrixX2d parameterizeCut(const Laplacian& laplacian, const TrianglesRef& triangles,
                                 const std::vector<std::vector<int>>& cuts, const ParameterizationOptions& options = {},
                                 ParameterizationReport* report = nullptr);

}  // namespace tufted
