#pragma once

#include <cstdint>
#include <vector>

#include "tufted/laplacian.h"
#include "tufted/solver.h"
#include "tufted/types.h"

namespace tufted {

/// Options of minimalSurface().
struct MinimalSurfaceOptions {
  /// Indices of any points that stay in place; empty: those on edges of one triangle, the rim.
  std::vector<int> fixed = {};
  /// > 0: iterations stop when no point moves off the surface by more than this part of the surface's extent, its
  /// largest side along an axis. Moves within the surface do not count, as they do not change it.
  double tolerance = 1e-4;
  int max_iterations = 300;   ///< >= 1; if they do not suffice, MinimalSurfaceReport::converged is false
  SolverOptions solver = {};  ///< how systems are solved
};

/// Counts, areas and time of a call of minimalSurface().
struct MinimalSurfaceReport {
  std::int64_t fixed = 0;     ///< points of triangles that stay in place
  std::int64_t moved = 0;     ///< points of triangles that could move
  std::int64_t floating = 0;  ///< points of triangles on parts without a fixed point; they stay in place
  int iterations = 0;         ///< iterations done
  double last_move =
      0;  ///< greatest distance that a point moved off the surface in the last iteration, in the caller's unit
  bool converged = false;  ///< whether `last_move` is within the tolerance
  double area_before = 0;  ///< area of all triangles at first, in the caller's unit squared
  double area = 0;         ///< area of all triangles in the result, in the caller's unit squared
  double seconds = 0;      ///< wall-clock
};

/// Computes the surface of least area that the fixed points span, or one whose area does not change to first order
/// (Pinkall, Polthier: "Computing discrete minimal surfaces and their conjugates", 1993, with the Laplacian of Sharp
/// and Crane 2020, Figure 18). Each iteration makes all free points harmonic, L x = 0, where L is the Laplacian of the
/// triangles at their present positions. So in the end each point is a mean of its neighbours with positive weights and
/// lies in their convex hull, however bad the triangles are.
/// @param laplacian with its positions, where the points start
/// @param triangles F x 3: those of the mesh, or surfaceTriangles() of a cloud, of any orientation. Triangles that
/// repeat a point, or have one that is not active, are left out.
/// @return N x 3. Points on no triangle, or on parts without a fixed point, stay at Laplacian::positions; coincident
/// points as their representative
/// @throws InvalidInput for arrays of the wrong size, indices or options out of range, positions that are not finite, a
///         fixed point on no triangle, no triangle, or no fixed point
/// @throws SolverFailure when a system cannot be solved, as where the surface collapses to lines between single points
/// @throws Cancelled when `options.solver.progress` returns false
Points minimalSurface(const Laplacian& laplacian, const TrianglesRef& triangles,
                      const MinimalSurfaceOptions& options = {}, MinimalSurfaceReport* report = nullptr);

}  // namespace tufted
