#pragma once

#include "tufted/laplacian.h"
#include "tufted/options.h"
#include "tufted/solver.h"
#include "tufted/types.h"

namespace tufted {

/// Options of meanCurvatureFlow().
struct MeanCurvatureFlowOptions {
  double time_step = 0.01;    ///< t in [1e-200, 1e200], as a share of the area of each connected component
  int steps = 10;             ///< >= 1; coarse samples leave the sphere again after tens of steps
  SolverOptions solver = {};  ///< how the systems are solved, threads and progress
};

/// Moves points by the conformalised mean curvature flow (Kazhdan, Solomon, Ben-Chen: "Can mean-curvature flow be
/// modified to be non-singular?", 2012). It turns a closed surface without handles into a sphere and, unlike the flow
/// itself, pinches no necks. Each step solves (M + t L) x' = M x for each coordinate, with the lumped areas M of the
/// moved triangles and the L of the first surface, and then scales each component about its middle so that its area
/// stays.
/// @param laplacian with positions, from which the points start
/// @param triangles F x 3 indices of points, as those of a mesh or surfaceTriangles(). Triangles with a corner that
/// takes no part are left out.
/// @return N x 3, in the unit of the points. Isolated and non-finite points, and components without area, keep their
/// place; coincident points move with their representative.
/// @throws InvalidInput for options out of range, a Laplacian without positions, arrays of the wrong size, or a corner
/// out of range
/// @throws SolverFailure when a step cannot be solved, or leaves a component without area
/// @throws Cancelled when `options.solver.progress` returns false
Points meanCurvatureFlow(const Laplacian& laplacian, const TrianglesRef& triangles,
                         const MeanCurvatureFlowOptions& options = {});

}  // namespace tufted
