#pragma once

#include "tufted/laplacian.h"
#include "tufted/types.h"

namespace tufted {

/// Gradients of functions at points, in the tangent frame of each point: (X u)_i is the slope of u along
/// frames.tangents and (Y u)_i the slope along cross(normal, tangent).
struct Gradients {
  SparseMatrix X;  ///< slopes along the tangents; N x N, compressed; 1 / length; rows sum to 0
  SparseMatrix Y;  ///< slopes along cross(normal, tangent), as X
  Frames frames;   ///< frames of the N points; arbitrary at points that belong to no surface
};

/// Tangent frames of a mesh's vertices. A normal is the direction that the normals of the triangles around, weighted by
/// area, deviate from least, whichever way each of them is oriented; its sign is that of their sum where they have one.
/// Vertices of no triangle get z as their normal.
/// @param triangles F x 3 indices into `points`; triangles with a corner that is not finite are left out
/// @throws InvalidInput for indices out of range
Frames meshFrames(const Points& points, const Triangles& triangles);

/// Gradients by least squares with equal weights: at each point, those of the linear function in the tangent plane that
/// fits u best at the point and its neighbours in L (DiffusionNet; Sharp et al. 2022, Section 3.4). Exact for linear
/// functions on a plane. If all neighbours lie on one line through the point, their neighbours are used as well; if
/// even these lie on it, the slope across the line is 0.
///
/// Rows of coincident points are those of their representative; other points that are not active have rows of zeros.
/// @param points N x 3, those that the Laplacian was built from
/// @throws InvalidInput for arrays of different sizes, or a Laplacian without frames, such as a mesh's
Gradients gradients(const Laplacian& laplacian, const Points& points);
/// Gradients in the caller's frames, otherwise as gradients(laplacian, points) finds them in the Laplacian's.
/// @param frames N x 3, orthonormal at active points; for meshes meshFrames()
Gradients gradients(const Laplacian& laplacian, const Points& points, const Frames& frames);

}  // namespace tufted
