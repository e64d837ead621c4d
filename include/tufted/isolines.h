#pragma once

#include <vector>

#include "tufted/options.h"
#include "tufted/polyline.h"
#include "tufted/types.h"

namespace tufted {

/// Computes the lines on which a field, linear within each triangle, has some values (marching triangles).
///
/// A corner whose value equals that of the line counts as above it, so that every triangle has one straight piece of
/// the line or none, and no case is special: on a closed surface all lines are closed. At an edge of one triangle a
/// line ends, and at an edge of more than two each triangle's line ends, because there is no telling which two belong
/// together. Lines also end at triangles with a value or a corner that is not finite, and at those with a repeated
/// corner. Larger values lie to the left of a line as seen from the front of the first triangle that it crosses. Points
/// in which a line stays several times in a row are listed once, and lines of a single point, as at a maximum that has
/// the value, are left out.
/// @param points N x 3, in any unit of length
/// @param triangles F x 3 indices into `points`: those of a mesh, or surfaceTriangles() of a cloud, whose points are
/// then Laplacian::positions. Triangles are neighbours if they share two indices; equal points do not count as one.
/// @param field N values in any unit; NaN and infinite values are allowed
/// @param values finite, any number, in the unit of the field
/// @param progress called before each value
/// @return the lines of the first value, then those of the second, and so on; the points of each lie on edges
/// @throws InvalidInput for a field of another size, an index out of range, or a value that is not finite
/// @throws Cancelled when `progress` returns false
std::vector<Polyline> isolines(const PointsRef& points, const TrianglesRef& triangles,
                               const Eigen::Ref<const VectorXd>& field, const std::vector<double>& values,
                               const Progress& progress = {});

}  // namespace tufted
