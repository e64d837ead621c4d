#pragma once

#include <cstdint>
#include <vector>

#include "tufted/laplacian.h"
#include "tufted/solver.h"
#include "tufted/types.h"

namespace tufted {

/// Options of minimalSurface().
struct MinimalSurfaceOptions {
  /// Points that stay in place, which may be any; empty: those of the rim, which lie on an edge of one triangle.
  std::vector<int> fixed = {};
  /// Iterations end where no point moves off the surface by more than this part of its extent, the largest side along
  /// an axis; > 0. Moves within the surface do not count, as they do not change it.
  double tolerance = 1e-4;
  int max_iterations = 300;   ///< >= 1; where they do not suffice, MinimalSurfaceReport::converged is false
  SolverOptions solver = {};  ///< how systems are solved
};

/// What minimalSurface() did.
struct MinimalSurfaceReport {
  std::int64_t fixed = 0;     ///< points of triangles that stayed in place
  std::int64_t moved = 0;     ///< points of triangles that could move
  std::int64_t floating = 0;  ///< points of triangles on parts without a fixed point, which stayed in place
  int iterations = 0;         ///< systems that were solved
  double last_move =
      0;  ///< the farthest that a point moved off the surface in the last iteration, in the caller's unit
  bool converged = false;  ///< whether that is within the tolerance
  double area_before = 0;  ///< of all triangles, in the caller's unit squared
  double area = 0;         ///< of all triangles in the end
  double seconds = 0;      ///< wall-clock
};

/// The surface of the least area that its fixed points span, or one where the area does not change to first order
/// (Pinkall, Polthier: "Computing discrete minimal surfaces and their conjugates", 1993, with the Laplacian of Sharp
/// and Crane 2020, Figure 18). In each iteration all points that are free become harmonic, L x = 0, L being the
/// Laplacian of the triangles as they lie then. So in the end each point is a mean of its neighbours with positive
/// weights, within their convex hull, however bad the triangles are.
/// @param laplacian with its positions, where the points start
/// @param triangles F x 3: those of the mesh, or surfaceTriangles() of a cloud; which way they turn does not matter.
///        Those that name a point twice, or one that is not active, are left out.
/// @return N x 3. Points on no triangle, and those on parts without a fixed point, stay at Laplacian::positions; a
///         coincident point lies where its representative does
/// @throws InvalidInput for arrays of the wrong size, indices or options out of range, positions that are not finite, a
///         fixed point on no triangle, no triangle, or no fixed point
/// @throws SolverFailure when a system cannot be solved, as where the surface shrinks to lines between single points
/// @throws Cancelled when `options.solver.progress` returns false
Points minimalSurface(const Laplacian& laplacian, const TrianglesRef& triangles,
                      const MinimalSurfaceOptions& options = {}, MinimalSurfaceReport* report = nullptr);

}  // namespace tufted
