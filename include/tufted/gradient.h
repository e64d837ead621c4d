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
  /// Number of neighbours in each fit beside the point itself, 0 or in [3, 10000]: the nearest of the points around it
  /// in L, ring by ring, and all as far as the last of them. 0: all neighbours in L. Empty: 30 for clouds, to average
  /// out noise, and 0 for meshes, whose edges were chosen.
  std::optional<int> neighbors = std::nullopt;
  /// >= 0, length^2, added to both eigenvalues of the sum of d d^T over the offsets d of the neighbours in a fit, which
  /// then passes through the value at the point, as in DiffusionNet, with 1e-5. It shortens gradients, more so where
  /// neighbourhoods are small in the unit of length. 0: off.
  double regularization = 0;
  int threads = 0;         ///< at most this many threads; 0: one per processor
  Progress progress = {};  ///< called while fits are made
};

/// Counts and timing of a call of gradients().
struct GradientReport {
  /// Points whose neighbours nearly lay on one line, so that more were taken.
  std::int64_t widened = 0;
  /// Points whose neighbours lie on one line however many are taken: the slope across the line is 0.
  std::int64_t on_a_line = 0;
  double mean_neighbors = 0;  ///< neighbours in the fits, on average over the active points
  double seconds = 0;         ///< wall-clock
};

/// Gradients of functions at points, in the tangent frame of each point: (X u)_i is the slope of u along
/// frames.tangents and (Y u)_i the slope along cross(normal, tangent).
struct Gradients {
  SparseMatrix X;  ///< slopes along the tangents; N x N, compressed; 1 / length; rows sum to 0
  SparseMatrix Y;  ///< slopes along cross(normal, tangent); as X
  Frames frames;   ///< frames of the N points, in which slopes are given; arbitrary at points that are not active
  GradientReport report;  ///< counts and timing
};

/// Computes tangent frames of a mesh's vertices. A normal is the direction from which the normals of the triangles
/// around deviate least, however each of them is oriented; its sign is that of their sum if they have a consistent one.
/// Triangles are weighted by area over extent, the greatest difference of a coordinate from the first corner to the
/// others, because areas may underflow. Vertices of no triangle get the z axis as normal. The orientation is
/// Orientation::given if no two triangles run along an edge in the same direction, otherwise arbitrary.
/// @param points V x 3
/// @param triangles F x 3 indices into `points`; triangles with a corner that is not finite are left out
/// @return frames of V vertices
/// @throws InvalidInput for indices out of range
Frames meshFrames(const PointsRef& points, const TrianglesRef& triangles);

/// Computes tangent frames of a mesh whose equal vertices are joined (MeshOptions::weld): joined vertices share the
/// frame of all their triangles.
/// @param points N x 3, of the mesh that the Laplacian was built from
/// @param triangles F x 3, of the mesh that the Laplacian was built from
/// @throws InvalidInput for indices out of range and arrays of the wrong size
Frames meshFrames(const Laplacian& laplacian, const PointsRef& points, const TrianglesRef& triangles);

/// Computes gradients by least squares with equal weights: at each point, the slope of the affine function that fits u
/// best at the point and its neighbours, in the plane that fits their positions best. So the gradients of the
/// coordinates x, y and z are the projections of the axes onto that plane, for any points. The normals of these planes
/// deviate a little from those of the Laplacian and lie on the same side.
///
/// Affine functions on a plane are exact. Where the neighbours nearly lie on one line more are taken, up to eight times
/// as many. Rows of coincident points are those of their representative; other points that are not active have rows of
/// zeros. The result has the same bits for any number of threads.
/// @param points N x 3, between which slopes are measured: the points that the Laplacian was built from or, for noisy
/// clouds, Laplacian::positions, where they were moved
/// @throws InvalidInput for arrays of different sizes, options out of range, or a Laplacian without frames (a mesh's)
/// @throws Cancelled when `options.progress` returns false
Gradients gradients(const Laplacian& laplacian, const PointsRef& points, const GradientOptions& options = {});
/// Computes gradients in the tangent planes of the caller's frames, for meshes those of meshFrames(); otherwise as
/// without.
/// @param frames N x 3 each, orthonormal at active points
Gradients gradients(const Laplacian& laplacian, const PointsRef& points, const Frames& frames,
                    const GradientOptions& options = {});

/// Divergence of a field of tangent vectors, the negative adjoint of the gradients: for every function u the sum of M u
/// div(v) is minus the sum of M (gradient of u) . v. Inside a surface it is what flows away from a point per area; at a
/// rim also what flows out across it.
/// @param gradients of `laplacian`
/// @param vectors N x 2, along the tangents and cross(normal, tangent) of gradients.frames; those of points that are
/// not active are ignored
/// @return N; 1 / length times the unit of the vectors; coincident points as their representative; 0 at other points
/// that are not active
/// @throws InvalidInput for arrays of different sizes, or vectors that are not finite at active points
VectorXd divergence(const Laplacian& laplacian, const Gradients& gradients,
                    const Eigen::Ref<const Eigen::MatrixX2d>& vectors);

}  // namespace tufted
