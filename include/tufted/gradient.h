#pragma once

#include "tufted/laplacian.h"
#include "tufted/types.h"

namespace tufted {

/// Gradients of functions at points, in the tangent frame of each: (X u)_i is the slope of u along frames.tangents and
/// (Y u)_i that along cross(normal, tangent).
struct Gradients {
  SparseMatrix X, Y;  ///< N x N, compressed; 1 / length; rows sum to 0
  Frames frames;      ///< N x 3 each; an arbitrary frame at points that belong to no surface
};

/// Tangent frames of a mesh's vertices. A normal is the direction that the normals of the triangles around, weighted by
/// area, deviate from least, whichever way each of them is oriented; its sign is that of their sum where they have one.
/// Vertices of no triangle get z as their normal.
/// @param triangles F x 3 indices into `points`; triangles with a corner that is not finite are left out
/// @throws InvalidInput for indices out of range
Frames meshFrames(const Points& points, const Triangles& triangles);

/// The linear function that meets u at a point and its neighbours in L best in the tangent plane (least squares with
/// equal weights, as DiffusionNet has it; Sharp et al. 2022, Section 3.4). Exact for linear functions on a plane. Where
/// all neighbours lie on one line through the point, theirs are asked as well; if even these do, the slope across is 0.
///
/// Rows of coincident points are those of their representative; other points that are not active have rows of zeros.
/// @param points N x 3, those that the Laplacian was built from
/// @throws InvalidInput for arrays of different sizes, or a Laplacian without frames, as of meshes
Gradients gradients(const Laplacian& laplacian, const Points& points);
/// The same in frames of the caller's.
/// @param frames N x 3, orthonormal at active points; for meshes meshFrames()
Gradients gradients(const Laplacian& laplacian, const Points& points, const Frames& frames);

}  // namespace tufted
