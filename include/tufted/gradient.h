#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "tufted/laplacian.h"
#include "tufted/options.h"
#include "tufted/types.h"

namespace tufted {

/// Options of gradients().
struct GradientOptions {
  /// How many neighbours a fit takes beside the point itself: of the points around in L, ring by ring, the nearest ones
  /// in space, and all that are as far as the last of them. 0: the neighbours in L. Empty: 30 for clouds, where one
  /// neighbour's noise must not count for much, and 0 for meshes, whose edges were chosen. Otherwise in [3, 10000].
  std::optional<int> neighbors = std::nullopt;
  /// 0, or a length^2 that is added to both spreads of a fit, which then goes through the value at the point: what
  /// DiffusionNet does, with 1e-5. It shortens gradients, the more the smaller the unit of length makes the
  /// neighbourhoods.
  double regularization = 0;
  int threads = 0;         ///< at most this many; 0: one per processor
  Progress progress = {};  ///< called while fits are made
};

/// What gradients() did.
struct GradientReport {
  /// Points whose neighbours hardly determined the slope across, so that more were taken.
  std::int64_t widened = 0;
  /// Points whose neighbours lie on one line however many are taken: the slope across is 0.
  std::int64_t on_a_line = 0;
  double mean_neighbors = 0;  ///< neighbours in the fits, on average over the active points
  double seconds = 0;         ///< wall-clock
};

/// Gradients of functions at points, in the tangent frame of each point: (X u)_i is the slope of u along
/// frames.tangents and (Y u)_i the slope along cross(normal, tangent).
struct Gradients {
  SparseMatrix X;         ///< slopes along the tangents; N x N, compressed; 1 / length; rows sum to 0
  SparseMatrix Y;         ///< slopes along cross(normal, tangent), as X
  Frames frames;          ///< frames of the N points; arbitrary at points that belong to no surface
  GradientReport report;  ///< what happened
};

/// Tangent frames of a mesh's vertices. A normal is the direction that the normals of the triangles around deviate from
/// least, whichever way each of them is oriented; its sign is that of their sum where they have one. Triangles are
/// weighted by area over extent, the greatest difference of a coordinate from the first corner to the others: a length,
/// as areas may underflow. Vertices of no triangle get z as their normal. The orientation is Orientation::given where
/// no two triangles run along an edge in one direction, else arbitrary.
/// @param triangles F x 3 indices into `points`; triangles with a corner that is not finite are left out
/// @throws InvalidInput for indices out of range
Frames meshFrames(const PointsRef& points, const TrianglesRef& triangles);

/// Frames of a mesh whose equal vertices are joined (MeshOptions::weld): joined vertices share the frame of all
/// their triangles.
/// @param points N x 3, of the mesh that the Laplacian was built from
/// @param triangles F x 3, of the mesh that the Laplacian was built from
/// @throws InvalidInput for indices out of range and arrays of the wrong size
Frames meshFrames(const Laplacian& laplacian, const PointsRef& points, const TrianglesRef& triangles);

/// Gradients by least squares with equal weights: at each point, the slope of the linear function with a constant that
/// fits u best at the point and its neighbours, in the plane that fits their positions best. So the coordinates x, y
/// and z, as functions on the points, have the gradients that the plane says: for any points, the parts of the axes
/// that lie in it. The normals are on the side that the Laplacian's are, which deviate a little.
///
/// Linear functions on a plane are exact. Where the neighbours nearly lie on one line more are taken, up to eight times
/// as many. Rows of coincident points are those of their representative; other points that are not active have rows of
/// zeros. The same bits result for any number of threads.
/// @param points N x 3, between which slopes are measured: those that the Laplacian was built from or, for noisy
/// clouds,
///        Laplacian::positions, where they were moved
/// @throws InvalidInput for arrays of different sizes, options out of range, or a Laplacian without frames, such as a
///         mesh's
/// @throws Cancelled when `options.progress` returns false
Gradients gradients(const Laplacian& laplacian, const PointsRef& points, const GradientOptions& options = {});
/// Gradients in the planes of the caller's frames, otherwise as above.
/// @param frames N x 3, orthonormal at active points; for meshes meshFrames()
Gradients gradients(const Laplacian& laplacian, const PointsRef& points, const Frames& frames,
                    const GradientOptions& options = {});

/// The divergence of tangent vectors, the adjoint of the gradients by the masses: for all functions u the sum of
/// M u div(v) is minus the sum of M (gradient of u) . v. On points without a rim it is what flows away from a point per
/// area; at a rim also what flows out over it.
/// @param gradients of `laplacian`
/// @param vectors N x 2, along the tangents and along cross(normal, tangent) of gradients.frames; those of points that
///        are not active are ignored
/// @return N; coincident points as their representative; 0 at other points that are not active
/// @throws InvalidInput for arrays of different sizes, or vectors that are not finite at active points
VectorXd divergence(const Laplacian& laplacian, const Gradients& gradients,
                    const Eigen::Ref<const Eigen::MatrixX2d>& vectors);

}  // namespace tufted
